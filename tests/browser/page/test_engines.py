"""Firefox and WebKitGTK on llvmpipe, under Xvfb: pixels, layout, touch, settings. Headless they have no WebGL."""

import base64
import os
import shutil
import subprocess
import urllib.request
from collections.abc import Callable, Iterator

import numpy as np
import pytest

from support.browser.axe import AXE, FINDS
from support.browser.engines import Engine, Firefox, WebKit
from support.browser.visits import DESKTOP, PHONE, link, pixels_of
from support.sweep import REST

WIDTH, HEIGHT, TIME = 160, 90, 2.7
PRESETS = ("paper-threshold", "default", "swell")
"""All 30 draw the server's pixels (once measured); these are fast ones of three kinds."""
ENGINES: dict[str, type[Firefox] | type[WebKit]] = {"firefox": Firefox, "webkit": WebKit}
SIZES = {"desktop": DESKTOP, "phone": PHONE}
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


def engines_at(**usual: str) -> pytest.MarkDecorator:
    """These engines at these sizes; the sweep has the others."""
    cases = [
        pytest.param(engine, size, id=f"{engine}-{name}", marks=() if name in usual.get(engine, "") else REST)
        for engine in ENGINES
        for name, size in SIZES.items()
    ]
    return pytest.mark.parametrize(("engine", "size"), cases, indirect=["engine"])


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


@pytest.fixture(scope="module")
def engines(display: str) -> Iterator[Callable[[str], Engine]]:
    """Browsers by name, each started once, and anew when it hangs: one test fails then, and not those after it."""
    running: dict[str, Engine] = {}

    def started(name: str) -> Engine:
        if name in running and running[name].hung:
            running.pop(name).close()
        if name not in running:
            running[name] = ENGINES[name](display)
        return running[name]

    yield started
    for browser in running.values():
        browser.close()


@pytest.fixture(params=ENGINES)
def engine(request: pytest.FixtureRequest, engines: Callable[[str], Engine]) -> Engine:
    return engines(request.param)


def opened(engine: Engine, server: str, preset: str, size: tuple[int, int]) -> None:
    engine.size(*size)
    engine.visit(f"{server}/#paused=1&quality=fast&preset={preset}&time={TIME}")
    engine.until(SETTLED)


def test_presets_are_the_servers_pixels_and_settings_change_the_scene(engine: Engine, server: str) -> None:
    """On the same llvmpipe, at most one pixel in ten thousand differs: the bar of Chromium."""
    opened(engine, server, "paper-threshold", (760, 500))
    # WebKit gives every renderer this name.
    renderer = "Apple GPU" if isinstance(engine, WebKit) else "llvmpipe"
    assert renderer in engine.evaluate("window.seafoam.renderer")
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
    engine.evaluate("document.querySelector('[data-tool=settings]').click()")
    engine.until("document.querySelector('#settings.open .tp-rotv') !== null")
    # While the panel slides in, its list is elsewhere a moment later.
    engine.until(
        "(({ x, y, width }) => document.elementFromPoint(x + width / 2, y + 5)?.id === 'scale')"
        "(document.querySelector('#scale').getBoundingClientRect())"
    )
    engine.evaluate(
        "((list) => { list.value = '0.5'; list.dispatchEvent(new Event('change')); })(document.querySelector('#scale'))"
    )
    engine.until(f"{SETTLED} && window.seafoam.state().timing.width === 380")
    assert engine.complaints == []


def nothing_lies_over_anything(engine: Engine, size: tuple[int, int]) -> None:
    assert engine.evaluate("document.querySelectorAll('.strip a').length") > 20
    assert engine.evaluate("document.querySelector('h1').checkVisibility({ checkVisibilityCSS: true })")
    assert engine.evaluate(OVERLAPS) == []
    assert engine.evaluate("document.documentElement.scrollWidth") <= size[0]


@pytest.mark.parametrize(
    ("engine", "kind", "size"),
    # WebKit's driver makes a mouse of a finger.
    [("firefox", "touch", PHONE), ("webkit", "mouse", PHONE), pytest.param("firefox", "mouse", DESKTOP, marks=REST)],
    indirect=["engine"],
)
def test_a_touch_raises_a_ring(engine: Engine, server: str, kind: str, size: tuple[int, int]) -> None:
    """And a drag a train of them, which is one step of undo."""
    opened(engine, server, "lake-calm", size)
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
    assert engine.complaints == []


@engines_at(firefox="phone")
def test_the_server_draws_where_it_is_asked_to(engine: Engine, server: str, size: tuple[int, int]) -> None:
    engine.size(*size)
    engine.visit(f"{server}/?draw=server#paused=1&quality=fast&preset=paper-threshold&time={TIME}")
    engine.until(f"{SETTLED} && document.querySelector('.served canvas')?.width > 0")
    click(engine, "Play")
    engine.until(f"window.seafoam.state().time > {TIME} + 0.2")
    click(engine, "Pause")
    engine.until(SETTLED)
    assert engine.complaints == []


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
    """Nothing is wider than the page, axe finds nothing, and the page has not complained."""
    assert engine.evaluate("document.documentElement.scrollWidth") <= size[0]
    engine.evaluate(f"(() => {{ {AXE}; return true; }})()")
    assert engine.evaluate(FINDS) == []
    assert engine.complaints == []


@engines_at(firefox="desktop", webkit="phone")
def test_the_page(engine: Engine, server: str, size: tuple[int, int]) -> None:
    opened(engine, server, "paper-threshold", size)
    surfaces_open_beside_the_picture(engine, size)
    a_water_is_found_by_words(engine, size)
    a_lost_context_comes_back(engine)
    the_picture_stays_while_the_server_is_away_or_slow(engine)
    for other in (*SIZES.values(), size):
        engine.size(*other)
        nothing_lies_over_anything(engine, other)
    the_accuracy_benchmark_opens(engine, size)
    assert engine.complaints == []


def surfaces_open_beside_the_picture(engine: Engine, size: tuple[int, int]) -> None:
    """Plan view and take home."""
    click(engine, "Frame plan")
    for view in ("Effects", "GLSL", "Changes", "Passes"):
        click(engine, view, ".sheet")
    sound(engine, size)
    click(engine, "Take home")
    engine.until("document.querySelector('[data-surface=take] pre')?.textContent.includes('curl')")
    sound(engine, size)


def a_water_is_found_by_words(engine: Engine, size: tuple[int, int]) -> None:
    engine.evaluate("document.dispatchEvent(new KeyboardEvent('keydown', { key: '/', bubbles: true }))")
    engine.until("document.querySelectorAll('.waters a').length > 20")
    sound(engine, size)
    engine.evaluate(
        "((field) => { field.value = 'figure 2'; field.dispatchEvent(new Event('input', { bubbles: true })); })"
        "(document.querySelector('.waters [type=search]'))"
    )
    engine.until("document.querySelectorAll('.waters a').length < 9")
    engine.evaluate("document.querySelector('.waters a[href*=paper-height]').click()")
    engine.until(f"window.seafoam.state().preset === 'paper-height' && {SETTLED}")
    follow(engine, link(preset="paper-threshold"))
    engine.until(f"window.seafoam.state().preset === 'paper-threshold' && {SETTLED}")
    engine.until("document.querySelector('.sheet, .waters') === null")


def a_lost_context_comes_back(engine: Engine) -> None:
    draw = f"window.seafoam.render('default', {{ time: {TIME}, width: 64, height: 36, quality: 'fast' }})"
    before = engine.evaluate(draw)["pixels"]
    engine.evaluate("window.seafoam.loseContext()")
    engine.until("/context lost/.test(document.querySelector('.toast')?.textContent)")
    engine.evaluate("window.seafoam.restoreContext()")
    engine.until(f"!window.seafoam.state().lost && {SETTLED}")
    assert engine.evaluate(draw)["pixels"] == before


def the_picture_stays_while_the_server_is_away_or_slow(engine: Engine) -> None:
    engine.evaluate("(window.own = fetch, window.fetch = () => Promise.reject(new TypeError('away')), true)")
    follow(engine, link(preset="paper-threshold", scene={"/foam/look": "textured"}))
    engine.until("/does not respond/.test(document.querySelector('.toast.error')?.textContent)")
    assert engine.evaluate("window.seafoam.state().pictures === 1 && !window.seafoam.state().lost")
    engine.evaluate(
        "(window.fetch = async (...asked) => {"
        " await new Promise((done) => setTimeout(done, 1500)); return window.own(...asked); }, true)"
    )
    follow(engine, link(preset="paper-threshold", scene={"/foam/look": "filtered"}))
    engine.until("window.seafoam.state().busy")
    assert engine.evaluate("window.seafoam.state().pictures === 1")
    engine.until(SETTLED)
    assert engine.evaluate("window.seafoam.state().changes.length") == 1
    engine.evaluate("(window.fetch = window.own, true)")


def the_accuracy_benchmark_opens(engine: Engine, size: tuple[int, int]) -> None:
    click(engine, "Accuracy benchmark")
    engine.until("document.querySelector('#accuracy.open [role=status]') !== null")
    click(engine, "Cancel", "#accuracy")
    sound(engine, size)


@engines_at(firefox="phone", webkit="desktop")
def test_chapter_and_laboratories(engine: Engine, server: str, size: tuple[int, int]) -> None:
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
