"""Firefox on llvmpipe, under Xvfb: pixels, layout, touch, settings. Headless, it has no WebGL there."""

import base64
import io
import os
import shutil
import subprocess
import urllib.request
from collections.abc import Iterator

import numpy as np
import pytest
from PIL import Image

from support.axe import AXE
from support.bidi import Firefox
from support.visits import DESKTOP, PHONE

WIDTH, HEIGHT, TIME = 160, 90, 2.7
PRESETS = ("paper-threshold", "default", "swell")
"""All 30 draw the server's pixels (once measured); these are fast ones of three kinds."""
SIZES = pytest.mark.parametrize("size", [DESKTOP, PHONE], ids=["desktop", "phone"])
SETTLED = "window.seafoam?.state().settled === true"
OVERLAPS = """(() => {
  const parts = '#tools > *, #gallery button, .strip em, .strip a, #transport, h1, #summary';
  // Of the strip, what it does not cut off.
  const box = (node) => {
    const { left, right, top, bottom } = node.getBoundingClientRect();
    const strip = node.closest('.strip')?.getBoundingClientRect() ?? { left: 0, right: innerWidth };
    return { left: Math.max(left, strip.left), right: Math.min(right, strip.right), top, bottom };
  };
  const seen = [...document.querySelectorAll(parts)]
    .filter((node) => node.checkVisibility({ checkVisibilityCSS: true }))
    .map((node) => [node.getAttribute('aria-label') ?? node.textContent.trim(), box(node)])
    .filter(([, { left, right }]) => left < right);
  const meet = (a, b) =>
    a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 1 && b.top < a.bottom - 1;
  return seen.flatMap(([name, a], i) =>
    seen.slice(i + 1).filter(([, b]) => meet(a, b)).map(([other]) => `${name} over ${other}`));
})()"""


@pytest.fixture(scope="module")
def display() -> Iterator[str]:
    """An X server of its own, whose number it chooses itself."""
    assert shutil.which("Xvfb"), "no Xvfb: apt-get install xvfb"
    read, write = os.pipe()
    command = ["Xvfb", "-displayfd", str(write), "-screen", "0", "1600x1200x24", "-nolisten", "tcp"]
    process = subprocess.Popen(command, pass_fds=[write], stderr=subprocess.DEVNULL)
    os.close(write)
    try:
        with os.fdopen(read) as number:
            yield f":{number.readline().strip()}"
    finally:
        process.terminate()
        process.wait(timeout=20)


@pytest.fixture(scope="module")
def firefox(display: str) -> Iterator[Firefox]:
    browser = Firefox(display)
    yield browser
    browser.close()


def opened(firefox: Firefox, server: str, preset: str, size: tuple[int, int]) -> None:
    firefox.size(*size)
    firefox.visit(f"{server}/#paused=1&quality=draft&preset={preset}&time={TIME}")
    firefox.until(SETTLED)


def test_presets_are_the_servers_pixels(firefox: Firefox, server: str) -> None:
    """On the same llvmpipe, at most one pixel in ten thousand differs: the bar of Chromium."""
    opened(firefox, server, "paper-threshold", (400, 300))
    assert "llvmpipe" in firefox.evaluate("window.seafoam.renderer")
    for preset in PRESETS:
        options = f"{{ time: {TIME}, width: {WIDTH}, height: {HEIGHT}, quality: 'draft' }}"
        drawn = firefox.evaluate(f"window.seafoam.render('{preset}', {options})")
        assert drawn["glError"] == 0
        ours = np.frombuffer(base64.b64decode(drawn["pixels"]), np.uint8).reshape(HEIGHT, WIDTH, 4)[..., :3]
        query = f"time={TIME}&width={WIDTH}&height={HEIGHT}&quality=draft&dither=false"
        with urllib.request.urlopen(f"{server}/api/frames/{preset}.png?{query}", timeout=120) as reply:
            truth = np.asarray(Image.open(io.BytesIO(reply.read())).convert("RGB"))
        assert truth.std() > 5.0
        assert (ours != truth).any(axis=-1).mean() <= 1e-4, preset
    assert firefox.complaints == []


@SIZES
def test_nothing_lies_over_anything(firefox: Firefox, server: str, size: tuple[int, int]) -> None:
    opened(firefox, server, "paper-threshold", size)
    assert firefox.evaluate("document.querySelectorAll('.strip a').length") > 20
    assert firefox.evaluate(OVERLAPS) == []
    assert firefox.evaluate("document.documentElement.scrollWidth") <= size[0]
    assert firefox.complaints == []


def test_settings_open_and_change_the_scene(firefox: Firefox, server: str) -> None:
    opened(firefox, server, "paper-threshold", (760, 500))
    firefox.evaluate("document.querySelector('[data-tool=settings]').click()")
    firefox.until("document.querySelector('#settings.open .tp-rotv') !== null")
    x, y, width = firefox.evaluate(
        "(({ x, y, width }) => [x, y, width])(document.querySelector('#scale').getBoundingClientRect())"
    )
    hit = f"document.elementFromPoint({x + width / 2}, {y + 5}).id"
    assert firefox.evaluate(hit) == "scale"
    firefox.evaluate(
        "((list) => { list.value = '0.5'; list.dispatchEvent(new Event('change')); })(document.querySelector('#scale'))"
    )
    firefox.until(f"{SETTLED} && window.seafoam.state().timing.width === 380")
    assert firefox.complaints == []


@pytest.mark.parametrize("kind", ["mouse", "touch"])
def test_a_touch_raises_a_ring(firefox: Firefox, server: str, kind: str) -> None:
    opened(firefox, server, "lake-calm", (560, 360))
    firefox.press(kind, (300, 250))
    firefox.until("window.seafoam.state().touches?.length === 1")
    camera = firefox.evaluate("window.seafoam.state().camera")
    firefox.press(kind, (200, 240), (260, 245), (320, 250))
    firefox.until(f"window.seafoam.state().touches.length > 3 && {SETTLED}")
    assert firefox.evaluate("window.seafoam.state().camera") == camera
    assert firefox.complaints == []


AXE_FINDS = """(async () => {
  const over = ({ effect, playState }) => playState !== 'running' || effect.getTiming().iterations === Infinity;
  while (!document.getAnimations().every(over)) await new Promise((done) => setTimeout(done, 50));
  return (await axe.run()).violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html.slice(0, 120))}`);
})()"""


def click(firefox: Firefox, name: str, within: str = "body") -> None:
    """Press the button of that name, once it is there."""
    found = (
        f"[...document.querySelectorAll('{within} button, {within} [role=button]')].find((each) =>"
        f" [each.getAttribute('aria-label'), each.textContent.trim()].includes('{name}'))"
    )
    firefox.until(f"{found} !== undefined")
    firefox.evaluate(f"{found}.click()")


def sound(firefox: Firefox, size: tuple[int, int]) -> None:
    """Nothing is wider than the page, axe finds nothing, and the page has not complained."""
    assert firefox.evaluate("document.documentElement.scrollWidth") <= size[0]
    firefox.evaluate(f"(() => {{ {AXE.read_text(encoding='utf-8')}; return true; }})()")
    assert firefox.evaluate(AXE_FINDS) == []
    assert firefox.complaints == []


@SIZES
def test_surfaces_beside_the_picture(firefox: Firefox, server: str, size: tuple[int, int]) -> None:
    """Plan view, take home, list of waters, undo."""
    opened(firefox, server, "paper-threshold", size)
    click(firefox, "Frame plan")
    for view in ("Effects", "GLSL", "Changes", "Passes"):
        click(firefox, view, ".sheet")
    sound(firefox, size)
    click(firefox, "Take home")
    firefox.until("document.querySelector('[data-surface=take] pre')?.textContent.includes('curl')")
    sound(firefox, size)
    firefox.evaluate("document.dispatchEvent(new KeyboardEvent('keydown', { key: '/', bubbles: true }))")
    firefox.until("document.querySelectorAll('.waters a').length > 20")
    sound(firefox, size)


@SIZES
def test_the_accuracy_benchmark_opens(firefox: Firefox, server: str, size: tuple[int, int]) -> None:
    opened(firefox, server, "paper-threshold", size)
    click(firefox, "Accuracy benchmark")
    firefox.until("document.querySelector('#accuracy.open [role=status]') !== null")
    click(firefox, "Cancel", "#accuracy")
    sound(firefox, size)


@SIZES
def test_chapter_and_laboratories(firefox: Firefox, server: str, size: tuple[int, int]) -> None:
    firefox.size(*size)
    firefox.visit(f"{server}/learn/")
    firefox.until("document.querySelector('figure[data-figure] .plate') !== null")
    firefox.evaluate("document.querySelector('figure[data-figure]').scrollIntoView()")
    firefox.until("document.querySelector('figure[data-live=true]') !== null")
    sound(firefox, size)
    firefox.visit(f"{server}/learn/laboratory/")
    firefox.until("document.querySelector('#strips[data-live=true]') !== null")
    sound(firefox, size)
    firefox.visit(f"{server}/masks/")
    firefox.until("document.querySelectorAll('.side[aria-busy=false]').length === 1")
    sound(firefox, size)
