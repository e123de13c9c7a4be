"""HTML pages, without external resources: the web client at ``/``, its chapter at ``/learn``, the API's at ``/docs``.

``/water/NAME`` is the page opened at a preset, with what link previews show; ``/water/`` is a list.
"""

import io
import mimetypes
import os
from functools import cache, lru_cache
from html import escape
from http import HTTPStatus
from pathlib import Path

from fastapi import FastAPI, Request
from PIL import Image, ImageOps
from starlette.datastructures import Headers
from starlette.responses import HTMLResponse, PlainTextResponse, RedirectResponse, Response
from starlette.staticfiles import StaticFiles
from starlette.types import Scope

from seafoam.api.http.answers import IMMUTABLE, NO_STORE, REVALIDATE
from seafoam.resources import data_dir
from seafoam.scene import Preset, load_preset, preset_names

PREVIEW = (1200, 630)
"""Width and height of a preview, pixels: the format that link previews show uncut."""
_TEMPLATES = Path(__file__).parent / "pages"
_QUALITY = 82
"""Pillow's ``quality`` of JPEG."""
_UNKNOWN = """      <h1>There is no water “{name}” here</h1>
      <p>The link may be old or misspelt.</p>"""
_LIST = """      <h1>Waters</h1>
      <ul>
{items}
      </ul>"""


@cache
def _template(name: str) -> str:
    return (_TEMPLATES / f"{name}.html").read_text(encoding="utf-8")


async def _water(name: str, request: Request) -> Response:
    try:
        preset = load_preset(name)
    except KeyError:
        return _unknown(name)
    index = data_dir("webclient") / "index.html"
    if not index.is_file():
        return PlainTextResponse(NOT_BUILT, headers={"Cache-Control": NO_STORE})
    text = _opened_at(preset, index.read_text(encoding="utf-8"), str(request.base_url))
    return HTMLResponse(text, headers={"Cache-Control": REVALIDATE})


async def _waters() -> HTMLResponse:
    presets = [load_preset(name) for name in preset_names()]
    items = [f'        <li><a href="./{each.name}">{escape(each.title)}</a></li>' for each in presets]
    content = _template("message").format(title="Waters", content=_LIST.format(items="\n".join(items)))
    return HTMLResponse(content, headers={"Cache-Control": REVALIDATE})


# A plain function: FastAPI runs it in a thread, so that decoding delays no other request.
def _link_preview(name: str) -> Response:
    still = data_dir("webclient") / "stills" / f"{name}.avif"
    if name not in preset_names() or not still.is_file():
        return _unknown(name)
    return Response(_preview(still), media_type="image/jpeg", headers={"Cache-Control": REVALIDATE})


def _unknown(name: str) -> HTMLResponse:
    content = _UNKNOWN.format(name=escape(name[:80]))
    return HTMLResponse(_template("message").format(title="Water not found", content=content), HTTPStatus.NOT_FOUND)


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


NOT_BUILT = """Seafoam is running, but its web client has not been built.

To build it, run:  make webclient
The API's description is at /openapi.json, a rendered frame at /api/frames/default.png.
"""


PAGES = {
    ".": "index.html",
    "masks": "masks/index.html",
    "learn": "learn/index.html",
    "learn/laboratory": "learn/laboratory/index.html",
}
"""Files of the build by the path of their page."""


class WebClient(StaticFiles):
    """Serves the built web client, or a text that says how to build it."""

    async def check_config(self) -> None:
        """Accept a missing build."""

    async def get_response(self, path: str, scope: Scope) -> Response:
        """Return a file, compressed with Brotli if the build contains that and the client takes it.

        Files under ``assets`` carry their hash in their name, so they never change.
        """
        folder = data_dir("webclient")
        if path in PAGES and not (folder / PAGES[path]).is_file():
            return PlainTextResponse(NOT_BUILT, headers={"Cache-Control": NO_STORE})
        # Browsers ask for it beside answers that are no page.
        path = "icon.svg" if path == "favicon.ico" else path
        packed = os.path.isfile(folder / f"{path}.br")  # False, too, for a name that no file can have
        chosen = f"{path}.br" if packed and "br" in Headers(scope=scope).get("accept-encoding", "") else path
        response = await super().get_response(chosen, scope)
        if packed:
            response.headers["Vary"] = "Accept-Encoding"
        if chosen != path:
            response.headers["Content-Type"] = mimetypes.guess_type(path)[0] or "application/octet-stream"
            response.headers["Content-Encoding"] = "br"
        response.headers["Cache-Control"] = IMMUTABLE if path.startswith("assets/") else REVALIDATE
        return response


def install(app: FastAPI) -> None:
    """Serve the pages on paths that no route of the application matches."""
    for path, page in (
        ("/water/", _waters), ("/water/{name}.jpg", _link_preview), ("/water/{name}", _water), ("/docs", _manual),
        ("/api/", _reference),
    ):  # fmt: skip
        app.add_api_route(path, page, include_in_schema=False)
    # The stills' type, which Python 3.11 knows only where the system tells it.
    mimetypes.add_type("image/avif", ".avif")
    app.router.default = WebClient(directory=data_dir("webclient"), html=True, check_dir=False)


async def _reference() -> Response:
    return RedirectResponse("../docs")


async def _manual() -> Response:
    """Return the API reference. Its scripts are part of the web client's build: FastAPI's own page uses a CDN and an
    inline script.
    """
    if not (data_dir("webclient") / "docs" / "swagger-ui-bundle.js").is_file():
        return PlainTextResponse(NOT_BUILT, headers={"Cache-Control": NO_STORE})
    return HTMLResponse(_template("manual"), headers={"Cache-Control": REVALIDATE})
