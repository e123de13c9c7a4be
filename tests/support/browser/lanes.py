"""Chromium on a chosen renderer, with the page open."""

import base64
import os
import shutil
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray
from playwright.sync_api import Browser, Page, Playwright

from seafoam.framegraph.plan import FramePlan
from support.scenes import Camera

HOST = "seafoam.test"
"""A name of this machine."""
COMMON = ["--no-sandbox", "--hide-scrollbars", f"--host-resolver-rules=MAP {HOST} 127.0.0.1"]
LANES = {
    # Chromium's --use-gl=egl alone stays on SwiftShader without a word; ANGLE on the system's EGL is what shares Mesa.
    "llvmpipe": ["--use-gl=angle", "--use-angle=gl-egl", "--ignore-gpu-blocklist"],
    "SwiftShader": ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
}


@dataclass(frozen=True)
class Lane:
    """A browser, and what its renderer's name must say."""

    name: str
    browser: Browser


def chromium() -> str:
    found = os.environ.get("SEAFOAM_CHROMIUM") or shutil.which("chromium") or shutil.which("chromium-browser")
    assert found, "no Chromium: apt-get install chromium"
    return found


def launched(playwright: Playwright, name: str, *, optimised: bool = False) -> Browser:
    """optimised: as users have it, which draws faster. Else programs are compiled in half the time, and the page's own
    parts are put together without GL, on which they would cost as much as the water."""
    arguments = [*COMMON, *LANES[name], *([] if optimised else ["--disable-gpu-compositing"])]
    left_out = {"GALLIVM_PERF"} if optimised else set()
    environment: dict[str, str | float | bool] = {k: v for k, v in os.environ.items() if k not in left_out}
    browser = playwright.chromium.launch(executable_path=chromium(), args=arguments, env=environment)
    # Playwright evaluates what wait_for_function waits for as text, and a test adds styles: the page's security policy
    # forbids both. The policy has tests of its own, which pass bypass_csp=False.
    vars(browser).update(
        new_context=partial(browser.new_context, bypass_csp=True), new_page=partial(browser.new_page, bypass_csp=True)
    )
    return browser


def opened(lane: Lane, server: str, *, width: int = 320, height: int = 180) -> Page:
    """The page, paused, with its first picture on the canvas, on the renderer that the lane names."""
    page = lane.browser.new_page(viewport={"width": width, "height": height}, device_scale_factor=1)
    page.goto(f"{server}/#paused=1&quality=fast&preset=paper-threshold", wait_until="load")
    page.wait_for_function("() => window.seafoam !== undefined")
    page.evaluate("() => window.seafoam.ready")
    renderer = page.evaluate("() => window.seafoam.renderer")
    assert lane.name.lower() in renderer.lower(), f"asked for {lane.name}, got {renderer}"
    return page


def complaints_of(page: Page) -> list[str]:
    """What the page complains of from now on: errors on its console, and those that nothing catches."""
    found: list[str] = []
    page.on("console", lambda said: found.append(said.text) if said.type == "error" else None)
    page.on("pageerror", lambda error: found.append(str(error)))
    return found


def answered(
    page: Page, what: str | FramePlan, *, time: float, size: tuple[int, int], **options: Camera | str
) -> tuple[NDArray[np.uint8], dict[str, dict[str, str]]]:
    """A frame of a preset or a plan by the page's own executor, (height, width, 4), opaque; SHA-256 of the programs'
    texts that the driver has, by program and stage.

    ``options``: ``quality`` of a preset, ``camera``.
    """
    asked: dict[str, Any] = {"time": time, "width": size[0], "height": size[1], **options}
    if isinstance(camera := options.get("camera"), Camera):
        asked["camera"] = camera.model_dump(mode="json")
    plan = what.model_dump(mode="json") if isinstance(what, FramePlan) else what
    answer = page.evaluate("([what, asked]) => window.seafoam.render(what, asked)", [plan, asked])
    assert answer["glError"] == 0
    pixels = np.frombuffer(base64.b64decode(answer["pixels"]), np.uint8).reshape(size[1], size[0], 4)
    assert (pixels[..., 3] == 255).all()
    return pixels, answer["sources"]


def rendered(
    page: Page, what: str | FramePlan, *, time: float, size: tuple[int, int], **options: Camera | str
) -> NDArray[np.uint8]:
    """The frame alone."""
    return answered(page, what, time=time, size=size, **options)[0]
