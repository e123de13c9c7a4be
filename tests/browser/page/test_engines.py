"""Firefox and WebKitGTK on llvmpipe, under Xvfb: pixels, layout, touch, settings. Headless they have no WebGL.

What axe finds, and what a page does while the server is away, is no other engine's: Chromium's tests have it.
"""

import base64
import os
import shutil
import subprocess
import urllib.request
from collections.abc import Iterator

import numpy as np
import pytest

from support.browser.engines import Engine, Firefox, WebKit
from support.browser.visits import DESKTOP, OVERLAPS, PHONE, link, pixels_of

WIDTH, HEIGHT, TIME = 160, 90, 2.7
PRESETS = ("paper-threshold", "default")
"""All 30 draw the server's pixels (once measured); these are fast ones of two kinds."""
SIZES: dict[type[Engine], tuple[int, int]] = {Firefox: DESKTOP, WebKit: PHONE}
SETTLED = "window.seafoam?.state().settled === true"


@pytest.fixture(scope="module")
def display() -> Iterator[str]:
    """An X server of its own, whose number it chooses itself."""
    assert shutil.which("Xvfb"), "no Xvfb: apt-get install xvfb"
    read, write = os.pipe()
    command = ["Xvfb", "-displayfd", str(write), "-screen", "0", "1600x1200x24", "-nolisten", "tcp", "-noreset"]
    process = subprocess.Popen(command, pass_fds=[write], stderr=subprocess.DEVNULL)
    os.close(write)
    try:
        with os.fdopen(read) as number:
            yield f":{number.readline().strip()}"
    finally:
        process.terminate()
        process.wait(timeout=20)


@pytest.fixture(scope="module", params=SIZES)
def engine(display: str, request: pytest.FixtureRequest) -> Iterator[Engine]:
    browser = request.param(display)
    yield browser
    browser.close()


def test_the_page(engine: Engine, server: str) -> None:
    size = SIZES[type(engine)]
    engine.size(*size)
    engine.visit(f"{server}/{link(time=TIME)}")
    engine.until(SETTLED)
    # WebKit gives every renderer this name.
    renderer = "Apple GPU" if isinstance(engine, WebKit) else "llvmpipe"
    assert renderer in engine.evaluate("window.seafoam.renderer")
    presets_are_the_servers_pixels(engine, server)
    a_touch_raises_a_ring(engine, size)
    settings_change_the_picture(engine, size)
    surfaces_open_beside_the_picture(engine, size)
    a_lost_context_comes_back(engine)
    the_server_draws_where_it_is_asked_to(engine)
    for other in (DESKTOP, PHONE):
        engine.size(*other)
        nothing_lies_over_anything(engine, other)
    assert engine.complaints == []


def presets_are_the_servers_pixels(engine: Engine, server: str) -> None:
    """On the same llvmpipe, at most one pixel in ten thousand differs: the bar of Chromium."""
    for preset in PRESETS:
        options = f"{{ time: {TIME}, width: {WIDTH}, height: {HEIGHT}, quality: 'fast' }}"
        drawn = engine.evaluate(f"window.seafoam.render('{preset}', {options})")
        assert drawn["glError"] == 0
        ours = np.frombuffer(base64.b64decode(drawn["pixels"]), np.uint8).reshape(HEIGHT, WIDTH, 4)[..., :3]
        query = f"time={TIME}&width={WIDTH}&height={HEIGHT}&quality=fast&dither=false"
        with urllib.request.urlopen(f"{server}/api/frames/{preset}.png?{query}", timeout=120) as reply:
            truth = pixels_of(reply.read())
        assert truth.std() > 5.0
        assert (ours != truth).any(axis=-1).mean() <= 1e-4, preset


def a_touch_raises_a_ring(engine: Engine, size: tuple[int, int]) -> None:
    """And a drag a train of them, which is one step of undo."""
    # WebKit's driver makes a mouse of a finger.
    kind = "mouse" if isinstance(engine, WebKit) else "touch"
    places = [(round(x * size[0]), round(y * size[1])) for x, y in ((0.15, 0.66), (0.5, 0.67), (0.85, 0.68))]
    engine.press(kind, places[1])
    engine.until("window.seafoam.state().touches?.length === 1")
    camera = engine.evaluate("window.seafoam.state().camera")
    engine.press(kind, *places)
    engine.until(f"window.seafoam.state().touches.length > 2 && {SETTLED}")
    assert engine.evaluate("window.seafoam.state().camera") == camera
    engine.evaluate(
        "document.body.dispatchEvent(new KeyboardEvent('keydown',"
        " { key: 'z', code: 'KeyZ', ctrlKey: true, bubbles: true }))"
    )
    engine.until("window.seafoam.state().touches.length === 1")


def settings_change_the_picture(engine: Engine, size: tuple[int, int]) -> None:
    click(engine, "Settings")
    engine.until("document.querySelector('#settings.open .tp-rotv') !== null")
    # While the panel slides in, its list is elsewhere a moment later.
    engine.until(
        "(({ x, y, width }) => document.elementFromPoint(x + width / 2, y + 5)?.id === 'scale')"
        "(document.querySelector('#scale').getBoundingClientRect())"
    )
    engine.evaluate(
        "((list) => { list.value = '0.5'; list.dispatchEvent(new Event('change')); })(document.querySelector('#scale'))"
    )
    engine.until(f"{SETTLED} && window.seafoam.state().timing.width === {size[0] // 2}")
    click(engine, "Close settings")


def surfaces_open_beside_the_picture(engine: Engine, size: tuple[int, int]) -> None:
    """Plan view, take home and the accuracy benchmark."""
    click(engine, "Frame plan")
    for view in ("Effects", "GLSL", "Changes", "Passes"):
        click(engine, view, ".sheet")
    sound(engine, size)
    click(engine, "Take home")
    engine.until("document.querySelector('[data-surface=take] pre')?.textContent.includes('curl')")
    sound(engine, size)
    click(engine, "Accuracy benchmark")
    engine.until("document.querySelector('#accuracy.open [role=status]') !== null")
    click(engine, "Cancel", "#accuracy")
    sound(engine, size)


def a_lost_context_comes_back(engine: Engine) -> None:
    """And nothing is open any more."""
    follow(engine, link(time=TIME))
    engine.until(f"document.querySelector('.sheet, #accuracy.open') === null && {SETTLED}")
    draw = f"window.seafoam.render('paper-halftone', {{ time: {TIME}, width: 64, height: 36, quality: 'fast' }})"
    before = engine.evaluate(draw)["pixels"]
    engine.evaluate("window.seafoam.loseContext()")
    engine.until("/context lost/.test(document.querySelector('.toast')?.textContent)")
    engine.evaluate("window.seafoam.restoreContext()")
    engine.until(f"!window.seafoam.state().lost && {SETTLED}")
    assert engine.evaluate(draw)["pixels"] == before


def the_server_draws_where_it_is_asked_to(engine: Engine) -> None:
    follow(engine, link(time=TIME, draw="server"))
    engine.until(f"{SETTLED} && document.querySelector('.served canvas')?.width > 0")
    click(engine, "Play")
    engine.until(f"window.seafoam.state().time > {TIME} + 0.2")
    click(engine, "Pause")
    engine.until(SETTLED)


def nothing_lies_over_anything(engine: Engine, size: tuple[int, int]) -> None:
    assert engine.evaluate("document.querySelectorAll('.strip a').length") > 20
    assert engine.evaluate("document.querySelector('h1').checkVisibility({ checkVisibilityCSS: true })")
    assert engine.evaluate(OVERLAPS) == []
    assert engine.evaluate("document.documentElement.scrollWidth") <= size[0]


def click(engine: Engine, name: str, within: str = "body") -> None:
    """Press the button of that name, once it is there."""
    found = (
        f"[...document.querySelectorAll('{within} button, {within} [role=button]')].find((each) =>"
        f" [each.getAttribute('aria-label'), each.textContent.trim()].includes('{name}'))"
    )
    engine.until(f"{found} !== undefined")
    engine.evaluate(f"{found}.click()")


def follow(engine: Engine, fragment: str) -> None:
    """Go where a link points, without loading the page again."""
    engine.evaluate(f"location.hash = {fragment!r}")


def sound(engine: Engine, size: tuple[int, int]) -> None:
    """Nothing is wider than the page, which has not complained."""
    assert engine.evaluate("document.documentElement.scrollWidth") <= size[0]
    assert engine.complaints == []


def test_chapter_and_laboratories(engine: Engine, server: str) -> None:
    size = DESKTOP if isinstance(engine, WebKit) else PHONE
    engine.size(*size)
    engine.visit(f"{server}/learn/")
    engine.until("document.querySelector('figure[data-figure] .plate') !== null")
    engine.evaluate("document.querySelector('figure[data-figure]').scrollIntoView()")
    engine.until("document.querySelector('figure[data-live=true]') !== null")
    sound(engine, size)
    engine.visit(f"{server}/learn/laboratory/")
    engine.until("document.querySelector('#strips[data-live=true]') !== null")
    sound(engine, size)
    engine.visit(f"{server}/masks/")
    engine.until("document.querySelectorAll('.side[aria-busy=false]').length === 1")
    sound(engine, size)
