"""``/water/NAME``: the page opened at a preset, with what link previews show; ``/water/``: a list."""

import io
from functools import lru_cache
from html import escape
from http import HTTPStatus
from pathlib import Path

from fastapi import FastAPI, Request
from PIL import Image, ImageOps
from starlette.responses import HTMLResponse, PlainTextResponse, RedirectResponse, Response

from seafoam.api.http.etags import REVALIDATE
from seafoam.resources import data_dir
from seafoam.scene.presets import Preset, load_preset, preset_names

PREVIEW = (1200, 630)
"""Width and height of a preview, pixels: the format that link previews show uncut."""
_QUALITY = 82
"""Pillow's ``quality`` of JPEG."""

_PAGE = """<!doctype html>
<html lang="en">
  <head>
    <meta charset="utf-8" />
    <meta name="viewport" content="width=device-width, initial-scale=1" />
    <meta name="color-scheme" content="dark" />
    <title>{title} · Seafoam</title>
    <link rel="icon" href="../icon.svg" type="image/svg+xml" />
    <link rel="stylesheet" href="../message.css" />
  </head>
  <body>
    <main>
{content}
      <p><a href="../">Open Seafoam</a></p>
    </main>
  </body>
</html>
"""
_UNKNOWN = """      <h1>There is no water “{name}” here</h1>
      <p>The link may be old or misspelt.</p>"""
_LIST = """      <h1>Waters</h1>
      <ul>
{items}
      </ul>"""


def install(app: FastAPI, not_built: str) -> None:
    """Serve the pages and their previews; ``not_built`` is the text that stands for a page without a built client."""

    async def page(name: str, request: Request) -> Response:
        try:
            preset = load_preset(name)
        except KeyError:
            return _unknown(name)
        index = data_dir("webclient") / "index.html"
        if not index.is_file():
            return PlainTextResponse(not_built, headers={"Cache-Control": "no-store"})
        text = _opened_at(preset, index.read_text(encoding="utf-8"), str(request.base_url))
        return HTMLResponse(text, headers={"Cache-Control": REVALIDATE})

    async def every() -> HTMLResponse:
        presets = [load_preset(name) for name in preset_names()]
        items = [f'        <li><a href="./{each.name}">{escape(each.title)}</a></li>' for each in presets]
        content = _PAGE.format(title="Waters", content=_LIST.format(items="\n".join(items)))
        return HTMLResponse(content, headers={"Cache-Control": REVALIDATE})

    # A plain function: FastAPI runs it in a thread, so that decoding delays no other request.
    def preview(name: str) -> Response:
        try:
            preset = load_preset(name)
        except KeyError:
            return _unknown(name)
        still = data_dir("webclient") / "stills" / f"{preset.name}.avif"
        if not still.is_file():
            width, height = PREVIEW
            return RedirectResponse(f"../api/frames/{preset.name}.png?width={width}&height={height}")
        return Response(_preview(still), media_type="image/jpeg", headers={"Cache-Control": REVALIDATE})

    app.add_api_route("/water/", every, include_in_schema=False)
    app.add_api_route("/water/{name}.jpg", preview, include_in_schema=False)
    app.add_api_route("/water/{name}", page, include_in_schema=False)


def _unknown(name: str) -> HTMLResponse:
    content = _UNKNOWN.format(name=escape(name[:80]))
    return HTMLResponse(_PAGE.format(title="Water not found", content=content), HTTPStatus.NOT_FOUND)


def _opened_at(preset: Preset, page: str, base: str) -> str:
    """Return the client's page, opened at a preset. base: address of the server, which preview services require."""
    title = f"{preset.title} · Seafoam"
    address = f"{base}water/{preset.name}"
    properties = {
        "og:type": "website",
        "og:site_name": "Seafoam",
        "og:title": title,
        "og:description": preset.summary,
        "og:url": address,
        "og:image": f"{address}.jpg",
        "og:image:type": "image/jpeg",
        "og:image:width": str(PREVIEW[0]),
        "og:image:height": str(PREVIEW[1]),
        "og:image:alt": preset.title,
    }
    tags = [f'<meta property="{name}" content="{escape(content)}" />' for name, content in properties.items()]
    tags += ['<meta name="twitter:card" content="summary_large_image" />', f'<link rel="canonical" href="{address}" />']
    before, _, after = page.partition('<meta name="description" content="')
    _, _, after = after.partition('"')
    page = f'{before}<meta name="description" content="{escape(preset.summary)}"{after}'
    page = page.replace('data-preset="default"', f'data-preset="{preset.name}"', 1)
    page = page.replace("<title>Seafoam</title>", "\n    ".join([f"<title>{escape(title)}</title>", *tags]), 1)
    # Before any address: the page's own are relative to the server's root.
    return page.replace("<head>", '<head>\n    <base href="../" />', 1)


@lru_cache(maxsize=64)
def _preview(still: Path) -> bytes:
    """Return the middle of a still as JPEG."""
    with Image.open(still) as picture:
        fitted = ImageOps.fit(picture.convert("RGB"), PREVIEW, Image.Resampling.LANCZOS)
    buffer = io.BytesIO()
    fitted.save(buffer, "JPEG", quality=_QUALITY, optimize=True, progressive=True)
    return buffer.getvalue()
