"""Surfaces beside the picture: the plan view; pictures with recipes, a zip, the requests of a frame."""

import base64
import hashlib
import io
import json
import subprocess
import sys
import zipfile
from collections.abc import Iterator
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import Page, expect

from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render.encode import read_recipe
from seafoam.render.encode.formats import encode_exr, encode_webp
from support.browser.lanes import Lane
from support.browser.visits import BLANK, Visit, differs, link, pixels_of, visit
from support.scenes import load_preset

ROOT = Path(__file__).resolve().parents[3]
SIZE = (400, 300)
CHANGES = {"/foam/mask_tile": 3.5, "/light/exposure": -0.75}
DROP = """([encoded, type]) => {
  const bytes = Uint8Array.from(atob(encoded), (letter) => letter.charCodeAt(0));
  const data = new DataTransfer();
  data.items.add(new File([bytes], 'dropped', { type }));
  for (const kind of ['dragover', 'drop'])
    window.dispatchEvent(new DragEvent(kind, { dataTransfer: data, bubbles: true, cancelable: true }));
}"""


def drop(page: Page, content: bytes, type: str = "image/png") -> None:
    """Drop a file on the page."""
    page.evaluate(DROP, [base64.b64encode(content).decode(), type])


def downloaded(page: Page, button: str) -> tuple[bytes, str]:
    """The file behind a button, and its name."""
    with page.expect_download(timeout=60_000) as download:
        page.get_by_role("button", name=button, exact=True).click()
    return Path(download.value.path()).read_bytes(), download.value.suggested_filename


def other_formats(png: bytes) -> dict[float, bytes]:
    """A WebP and an OpenEXR file with the recipe of a PNG but times of their own, which are the keys, s."""
    recipe = json.loads(read_recipe(png))
    texts = {time: json.dumps(recipe | {"time": time}) for time in (1.5, 2.5)}
    return {
        1.5: encode_webp(np.zeros((2, 2, 3), dtype=np.uint8), texts[1.5]),
        2.5: encode_exr(np.zeros((2, 2, 4), dtype=np.float32), "half", texts[2.5]),
    }


def restored(made: Visit, preset: str) -> dict[str, Any]:
    """The state once a dropped picture is restored."""
    made.page.wait_for_function("(preset) => window.seafoam.state().preset === preset", arg=preset, timeout=30_000)
    made.page.wait_for_function("() => !window.seafoam.state().busy", timeout=60_000)
    state = made.state()
    for told in ("timing", "settled", "still", "surface"):
        state.pop(told, None)
    return state


@pytest.fixture(scope="module")
def taken(llvmpipe: Lane, server: str) -> Iterator[Visit]:
    """A page at which pictures are taken home and plans are looked at."""
    with visit(llvmpipe, server, link(open="take"), size=SIZE) as made:
        yield made


def test_a_frame_of_the_server_restores_the_view_and_gives_the_same_bytes(taken: Visit) -> None:
    start = {"time": 4.1234567890123, "scene": CHANGES, "camera": "1,7,-2,0.3,-0.2,0,0.9"}
    taken.follow(link(open="take", **start))
    first, name = downloaded(taken.page, "PNG, drawn by the server")
    assert name == "seafoam-paper-halftone-4.12s-server.png"
    before = restored(taken, "paper-halftone")
    taken.follow(link(preset="paper-height"))
    for time, content in {**other_formats(first), before["time"]: first}.items():
        drop(taken.page, content)
        taken.page.wait_for_function("(time) => window.seafoam.state().time === time", arg=time, timeout=30_000)
    after = restored(taken, "paper-halftone")
    assert after == before
    assert dict(after["changes"]) == CHANGES
    taken.press("Take home")
    again, _ = downloaded(taken.page, "PNG, drawn by the server")
    assert hashlib.sha256(again).hexdigest() == hashlib.sha256(first).hexdigest()


def test_a_picture_of_the_page_restores_itself_and_other_files_are_refused_in_plain_words(taken: Visit) -> None:
    taken.follow(link(time=2.5, split="/foam/look~textured~filtered~0.250"))
    first, _ = downloaded(taken.page, "Save image as PNG")
    before = restored(taken, "paper-halftone")
    taken.follow(link(preset="paper-height", open="take"))
    picture = {"name": "seafoam.png", "mimeType": "image/png", "buffer": first}
    taken.page.get_by_label("Restore from a picture").set_input_files(picture)
    assert restored(taken, "paper-halftone") == before
    again, _ = downloaded(taken.page, "Save image as PNG")
    assert (pixels_of(again) == pixels_of(first)).all()
    drop(taken.page, b"not a picture")
    taken.page.locator(".toast.error", has_text="not a PNG, WebP or OpenEXR").wait_for()
    assert restored(taken, "paper-halftone") == before
    taken.start_again()


def test_the_zip_draws_what_the_server_draws(taken: Visit, llvmpipe: Lane, server: str, tmp_path: Path) -> None:
    taken.follow(link(preset="default", time=2.7, scene=CHANGES, open="take"))
    content, name = downloaded(taken.page, "Zip")
    assert name == "seafoam-default.zip"
    served, _ = downloaded(taken.page, "PNG, drawn by the server")
    zipfile.ZipFile(io.BytesIO(content)).extractall(tmp_path)
    for snippet in (ROOT / "docs/snippets").iterdir():
        assert (tmp_path / "snippets" / snippet.name).read_bytes() == snippet.read_bytes()
    with visit(llvmpipe, server, BLANK, size=SIZE, settle=False) as made:
        made.page.goto(f"{(tmp_path / 'index.html').as_uri()}#paused")
        made.page.wait_for_function("() => document.documentElement.dataset.state", timeout=60_000)
        assert made.page.locator("#failure").inner_text() == ""
        png, _ = downloaded(made.page, "Save PNG")
        assert [url for _, url in made.asked if not url.startswith(("file://", "data:", "blob:"))] == []
    drawn = pixels_of(png)
    assert drawn.std() > 5.0
    assert differs(drawn, pixels_of(served)) <= 1e-4
    recipes = [json.loads(Image.open(io.BytesIO(one)).text["seafoam"]) for one in (png, served)]
    for told in ("scene", "quality", "camera", "time", "width", "height", "preset"):
        assert recipes[0][told] == recipes[1][told], told


def test_the_requests_give_this_frame(taken: Visit, tmp_path: Path) -> None:
    """Of a preset and of a changed scene: they are requests of two kinds."""
    commands = {
        "curl": ["sh", "-c"],
        "Python": [sys.executable, "-c"],
        "JavaScript": [str(ROOT / "scripts" / "node.sh"), "node", "--input-type=module", "-e"],
    }
    for parts in ({"camera": "1,7,-2,0.3,-0.2,0,0.9"}, {"scene": CHANGES}):
        taken.follow(link(time=3.25, open="take", **parts))
        want, _ = downloaded(taken.page, "PNG, drawn by the server")
        for language, command in commands.items():
            taken.page.get_by_role("button", name=language, exact=True).click()
            text = taken.page.locator(f"pre[aria-label={language}]").inner_text()
            subprocess.run([*command, text], cwd=tmp_path, check=True, timeout=60, capture_output=True)
            got = tmp_path / "frame.png"
            assert got.read_bytes() == want, (language, parts)
            got.unlink()


def tab(made: Visit, name: str) -> None:
    made.page.locator(".sheet").get_by_role("button", name=name, exact=True).click()


def test_the_plan_view_shows_effects_passes_changes_and_the_glsl_as_the_driver_has_it(taken: Visit) -> None:
    plan = make_plan(load_preset("default").scene, TIERS["fast"])
    taken.follow(link(preset="default", open="plan"))
    sheet = taken.page.locator(".sheet")
    tab(taken, "Passes")
    for when in {one.when for one in plan.passes}:
        part = sheet.locator(f".kind.{when}")
        part.locator("summary").click()
        rows = part.locator("tbody tr td:first-child").all_inner_texts()
        assert rows == [one.name for one in plan.passes if one.when == when]
    # llvmpipe's timers are wrong: the page says so, and shows no number.
    assert "CPU" in sheet.get_by_text("Time of each pass").inner_text()
    assert sheet.locator("tbody td:last-child").all_inner_texts() == [""] * len(plan.passes)
    tab(taken, "Effects")
    for kind, effects in ((":not(.skipped)", plan.effects), (".skipped", plan.skipped)):
        told = sheet.locator(f".notes{kind} > li").all_inner_texts()
        assert [effect.why for effect, text in zip(effects, told, strict=True) if effect.why not in text] == []
    tab(taken, "GLSL")
    for name, stage in product(("surface", "present"), ("vertex", "fragment")):
        sheet.get_by_label("Program").select_option(name)
        tab(taken, stage)
        shader = getattr(plan.programs[name], stage)
        sheet.get_by_text("As the driver has it").get_by_text(shader.sha256[:12]).wait_for()
        text = taken.page.evaluate("() => document.querySelector('pre.glsl').textContent")
        assert hashlib.sha256(text.encode()).hexdigest() == shader.sha256
    taken.follow(link(open="plan", scene={"/foam/look": "textured"}))
    tab(taken, "Changes")
    expect(sheet.locator(".plan-changes li").filter(has_text="program surface changed")).to_have_count(1)
