"""Pictures of docs/tour.md: each view of a running server's page, as a visitor sees it.

.venv/bin/python docs/make_tour.py http://127.0.0.1:8000 [view ...]
"""

import io
import os
import shutil
import sys
from dataclasses import dataclass
from pathlib import Path

from PIL import Image
from playwright.sync_api import Page, sync_playwright

PICTURES = Path(__file__).parent / "pictures" / "tour"
DESKTOP, PHONE = (1440, 900), (390, 844)
ARGUMENTS = ["--no-sandbox", "--hide-scrollbars", "--use-gl=angle", "--use-angle=gl-egl", "--ignore-gpu-blocklist"]
SETTLED = "window.seafoam?.state().settled === true"
TIMEOUT = 300_000
"""A page on a software renderer compiles for minutes, ms."""
SWEEP = 900_000
"""The accuracy view measures every quality, ms."""


@dataclass(frozen=True)
class View:
    """One picture: the address, what to wait for, what to press first."""

    address: str
    ready: str = SETTLED
    press: str | None = None
    then: str = "true"
    size: tuple[int, int] = DESKTOP
    pause: int = 600
    """For what fades, ms."""


VIEWS = {
    "page": View("#paused=1"),
    "phone": View("water/lake-sunset#paused=1", size=PHONE),
    "list": View("#paused=1", press="#gallery button", then="document.querySelector('.waters') !== null"),
    "settings": View("water/coastline#paused=1", press="[data-tool=settings]", pause=1500),
    "compare": View("#paused=1&split=/foam/look~textured~filtered~0.500"),
    "plan": View("#paused=1&open=plan", then="document.querySelector('.sheet .node') !== null"),
    "take": View("#paused=1&open=take", then="document.querySelector('[data-surface=take] pre') !== null"),
    "accuracy": View(
        "water/paper-halftone#paused=1&accuracy=1",
        then="/qualities/.test(document.querySelector('#accuracy [role=status]')?.textContent ?? '')",
        pause=3000,
    ),
    "learn": View("learn/", "document.readyState === 'complete'", pause=4000),
    "laboratory": View("learn/laboratory/", "document.querySelector('#strips[data-live=true]') !== null", pause=4000),
    "masks": View("masks/", "document.querySelector('.side[aria-busy=false]') !== null", pause=2000),
    "source": View("source/shaders/foam/look.glsl.html#halftone", "document.readyState === 'complete'"),
    "api": View("docs", "document.querySelector('.opblock') !== null"),
    "server": View("?draw=server#paused=1"),
}


def shoot(page: Page, server: str, view: View) -> Image.Image:
    page.goto(f"{server}/{view.address}")
    page.wait_for_function(f"() => {view.ready}", timeout=TIMEOUT)
    if view.press is not None:
        page.locator(view.press).first.click()
    page.wait_for_function(f"() => {view.then}", timeout=SWEEP)
    # The hint of the first half minute says nothing that the text does not.
    page.add_style_tag(content=".hint { visibility: hidden }")
    page.wait_for_timeout(view.pause)
    return Image.open(io.BytesIO(page.screenshot())).convert("RGB")


def main(server: str, names: list[str]) -> None:
    PICTURES.mkdir(parents=True, exist_ok=True)
    executable = os.environ.get("SEAFOAM_CHROMIUM") or shutil.which("chromium") or shutil.which("chromium-browser")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=executable, args=ARGUMENTS)
        for name in names or VIEWS:
            view = VIEWS[name]
            width, height = view.size
            viewport = {"width": width, "height": height}
            # Playwright evaluates what it waits for as text, which the page's policy forbids.
            context = browser.new_context(viewport=viewport, reduced_motion="reduce", bypass_csp=True)  # type: ignore[arg-type]
            picture = shoot(context.new_page(), server, view)
            picture.thumbnail((960, 960))
            picture.save(PICTURES / f"{name}.webp", quality=80, method=6)
            print(name, flush=True)
            context.close()


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
