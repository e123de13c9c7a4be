"""Draws the stills of the chapter's figures, shown where there is no script; run it as a script after a build.

Each is the figure's plate as Chromium draws it, paused at its start, at the width of the page's column.
"""

import io
import subprocess
import sys
import time
import urllib.error
import urllib.request
from pathlib import Path

from PIL import Image
from playwright.sync_api import sync_playwright

FOLDER = Path(__file__).parent / "public" / "learn-stills"
FIGURES = ("saturation", "threshold", "popping", "masks", "equations", "picture")
PORT = 8790
WIDTH = 1440
QUALITY = 72

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
from support.browser.lanes import launched  # noqa: E402


def answer(address: str) -> None:
    """Wait until a server answers."""
    for _ in range(200):
        try:
            urllib.request.urlopen(address, timeout=5).close()
        except (urllib.error.URLError, ConnectionError):
            time.sleep(0.2)
        else:
            return
    raise RuntimeError(f"{address} does not answer")


def main() -> None:
    """Write one WebP a figure."""
    FOLDER.mkdir(exist_ok=True)
    server = subprocess.Popen([Path(sys.executable).with_name("seafoam"), "serve", "--port", str(PORT)])
    try:
        answer(f"http://127.0.0.1:{PORT}/readyz")
        with sync_playwright() as playwright:
            browser = launched(playwright, "llvmpipe")
            page = browser.new_page(viewport={"width": WIDTH, "height": 900}, reduced_motion="reduce")
            page.goto(f"http://127.0.0.1:{PORT}/learn/")
            for name in FIGURES:
                figure = page.locator(f"figure[data-figure={name}]")
                figure.scroll_into_view_if_needed()
                live = "(name) => document.querySelector(`[data-figure=${name}]`).dataset.live"
                page.wait_for_function(live, arg=name)
                # Spectra follow their patterns.
                page.wait_for_timeout(1500)
                picture = Image.open(io.BytesIO(figure.locator(".plate").screenshot()))
                picture.convert("RGB").save(FOLDER / f"{name}.webp", quality=QUALITY, method=6)
                print(name, picture.size)
            browser.close()
    finally:
        server.terminate()
        server.wait(timeout=20)


if __name__ == "__main__":
    main()
