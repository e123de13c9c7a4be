"""The notebook's widget in a page: anywidget's model stands in for the notebook's, and asks the widget in Python.

The page comes through a proxy and over plain HTTP, as a notebook's may, where browsers lack a few functions.
"""

import base64
import json
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Page

from seafoam.notebook import Water
from support.browser.lanes import Lane, complaints_of
from support.browser.visits import drag, pixels_of

# What a notebook's front end does: keeps the traits, tells Python what changed, and passes messages on.
MODEL = """async ({ state }) => {
  const listeners = {};
  const fire = (event, ...values) => (listeners[event] ?? []).forEach((listener) => listener(...values));
  const bytes = (text) => new DataView(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer);
  let changed = {};
  const model = {
    get: (name) => state[name],
    set: (name, value) => { state[name] = changed[name] = value; fire(`change:${name}`); },
    save_changes: () => { if (Object.keys(changed).length) window.tell(JSON.stringify(changed)); changed = {}; },
    on: (event, listener) => (listeners[event] ??= []).push(listener),
    off: (event, listener) => (listeners[event] = listeners[event].filter((one) => one !== listener)),
    send: (content) => window.ask(JSON.stringify(content)).then(([answer, parts]) =>
      fire("msg:custom", answer, parts.map(bytes))),
  };
  window.push = (traits) => {
    Object.assign(state, traits);
    Object.keys(traits).forEach((name) => fire(`change:${name}`));
  };
  const { default: widget } = await import(new URL("../notebook/seafoam-widget.js", location.href));
  window.leave = widget.render({ model, el: document.getElementById("cell") });
  window.heard = () => Object.values(listeners).flat().length;
}"""


class Cell:
    """A widget, and a page that shows it."""

    def __init__(self, page: Page, water: Water) -> None:
        self.page, self.water = page, water
        self.asked: list[str] = []
        self.complaints = complaints_of(page)
        page.expose_function("ask", self._ask)
        page.expose_function("tell", lambda changed: water.set_state(json.loads(changed)))

    def _ask(self, request: str) -> list[Any]:
        answers: list[list[Any]] = []
        self.water.send = lambda content, parts=(): answers.append(
            [content, [base64.b64encode(part).decode() for part in parts]]
        )
        content = json.loads(request)
        self.asked.append(content["kind"])
        self.water._answer(self.water, content, [])
        (answer,) = answers
        return answer

    def show(self) -> None:
        self.page.evaluate(MODEL, {"state": self.state()})
        self.page.wait_for_function(
            "() => document.querySelector('.seafoam-picture canvas')?.width > 300", timeout=120_000
        )
        self.settle()

    def state(self, *names: str) -> dict[str, Any]:
        state = self.water.get_state(names or None)
        return {name: value for name, value in state.items() if not name.startswith("_") and name != "layout"}

    def push(self, *names: str) -> None:
        """As the notebook does after a change in Python."""
        self.page.evaluate("(traits) => window.push(traits)", self.state(*names))

    def settle(self) -> None:
        """Until one picture is left, and two looks at it are alike."""
        self.page.wait_for_function(
            "() => document.querySelectorAll('.seafoam-picture canvas').length === 1", timeout=120_000
        )
        before = self.seen()
        for _ in range(60):
            self.page.wait_for_timeout(700)
            now = self.seen()
            if now.std() > 1 and (now == before).all():
                return
            before = now
        raise AssertionError("the picture does not come to rest")

    def until(self, done: Callable[[], bool]) -> None:
        """Until Python has been told."""
        for _ in range(120):
            if done():
                return
            self.page.wait_for_timeout(250)
        raise AssertionError("Python was not told")

    def seen(self) -> np.ndarray:
        shot = self.page.locator(".seafoam-picture").screenshot()
        return pixels_of(shot).astype(float)


@pytest.fixture(scope="module")
def cell(llvmpipe: Lane, behind: str) -> Iterator[Cell]:
    with llvmpipe.browser.new_context(viewport={"width": 960, "height": 600}) as context:
        page = context.new_page()
        asked: list[str] = []
        page.on("request", lambda request: asked.append(request.url))
        made = Cell(page, Water("paper-halftone", time=4.0, quality="fast", playing=False))
        # In the place of a server's own page: one that the test makes up may not load what lies on this machine.
        page.goto(f"{behind}/water/")
        page.evaluate("() => { document.body.innerHTML = '<div id=cell style=\"width: 640px\"></div>'; }")
        made.show()
        yield made
        page.evaluate("() => window.leave()")
        assert page.locator("#cell").inner_html() == ""
        assert page.evaluate("() => window.heard()") == 0
        assert made.complaints == []
        assert [url for url in asked if url.startswith("http") and not url.startswith(f"{behind}/")] == []


def test_it_draws_what_python_has_and_changes(cell: Cell) -> None:
    assert cell.page.evaluate("() => crypto.randomUUID === undefined")
    assert cell.asked[0] == "plan"
    assert "texture" in cell.asked
    first = cell.seen()
    assert first.std() > 5
    cell.water.time = 9.0
    cell.push("time")
    cell.settle()
    later, plans = cell.seen(), cell.asked.count("plan")
    assert np.abs(later - first).mean() > 1
    # A field that stands in the plan needs no other; another water does.
    scene = cell.water.scene
    cell.water.scene = scene.model_copy(update={"foam": scene.foam.model_copy(update={"albedo": 0.2})})
    cell.push("scene")
    cell.settle()
    assert np.abs(cell.seen() - later).mean() > 0.5
    assert cell.asked.count("plan") == plans
    cell.water.scene = scene.model_copy(update={"foam": scene.foam.model_copy(update={"mask": "vac-99"})})
    cell.push("scene")
    message = cell.page.locator(".seafoam-message")
    message.wait_for()
    assert "vac-99" in message.inner_text()
    cell.water.scene = "paper-height"
    cell.push("scene", "camera")
    message.wait_for(state="hidden")
    cell.settle()
    assert np.abs(cell.seen() - later).mean() > 1


def test_python_follows_what_is_done_on_the_page(cell: Cell) -> None:
    began, yaw = cell.water.time, cell.water.camera.yaw
    box = cell.page.locator(".seafoam-picture").bounding_box()
    drag(cell.page, (box["x"] + 300, box["y"] + 200), (box["x"] + 380, box["y"] + 200))
    cell.until(lambda: cell.water.camera.yaw != yaw)
    cell.page.get_by_role("button", name="Play").click()
    cell.until(lambda: cell.water.playing and cell.water.time > began)
    cell.page.get_by_role("button", name="Pause").click()
    cell.page.get_by_role("button", name="Scene").click()
    cell.page.get_by_label("look", exact=True).select_option("fading")
    cell.until(lambda: cell.water.scene.foam.look == "fading")
    assert not cell.water.playing
    assert cell.water.panel
    heights = [cell.page.locator(f".seafoam-{part}").bounding_box()["height"] for part in ("side", "picture")]
    assert heights[0] == pytest.approx(heights[1], abs=1)
