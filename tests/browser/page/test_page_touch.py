"""Touching the water on the page, and edits of the scene: taps, drags, fingers; undone, compared, copied, pasted."""

import json
from collections.abc import Iterator

import numpy as np
import pytest
from playwright.sync_api import expect

from support.browser.lanes import Lane
from support.browser.visits import Visit, differs, drag, link, visit
from support.scenes import load_preset

SIZE = (560, 360)
LAKE = link(preset="lake-calm", time=2.0)


@pytest.fixture(scope="module")
def shared_lake(llvmpipe: Lane, server: str) -> Iterator[Visit]:
    with visit(llvmpipe, server, LAKE, size=SIZE, reduced_motion="reduce") as made:
        yield made


@pytest.fixture
def lake(shared_lake: Visit) -> Iterator[Visit]:
    """A still lake, paused, as nobody has touched it."""
    with shared_lake.awake():
        shared_lake.start_again(LAKE)
        yield shared_lake


def touches(made: Visit) -> list[dict[str, float]]:
    return made.state()["touches"] or []


def drawn(made: Visit) -> None:
    """The plan with room for touches is here."""
    made.page.wait_for_function("() => window.seafoam.state().touches !== null && !window.seafoam.state().busy")
    made.settle()


def test_a_tap_raises_a_ring_there(lake: Visit) -> None:
    """Pixels change around the tap and nowhere else; the server draws the same; the past has no ring."""
    before, asked, camera = lake.picture(), lake.plans(), lake.state()["camera"]
    lake.page.mouse.click(300, 250)
    drawn(lake)
    after = lake.picture()
    changed = (after != before).any(axis=-1)
    rows, columns = np.nonzero(changed)
    assert changed.mean() > 0.002
    assert abs(np.median(columns) - 300) < 25
    assert abs(np.median(rows) - 250) < 25
    # Where rays may meet a ring they begin earlier, and a tie between two levels may fall otherwise.
    assert np.abs(after.astype(int) - before)[:100].max() <= 1
    assert lake.plans() == asked + 1
    assert lake.state()["camera"] == camera
    lake.settings()
    served, _ = lake.saved("Render on server")
    assert differs(served, after) < 1e-4
    lake.press("Close settings")
    # A second touch needs no plan.
    lake.page.mouse.click(200, 220)
    lake.page.wait_for_function("() => window.seafoam.state().touches.length === 2")
    assert differs(lake.picture(), after) > 0.002
    assert lake.plans() == asked + 1
    lake.enter("Time in seconds", "1")
    touched = lake.picture()
    lake.page.get_by_role("button", name="Touch water").focus()
    lake.follow(link(preset="lake-calm", time=1.0))
    assert lake.state()["touches"] is None
    assert (lake.picture() == touched).all(), "before its time a ring is not there"


def test_touches_are_steps_of_undo_and_a_link_restores_them(small: Visit) -> None:
    """Two taps at once, as fast as they come while the first plan is made, and a slow drag: three steps."""
    for x in (200, 360):
        small.page.mouse.click(x, 260)
    drawn(small)
    small.page.mouse.move(120, 240)
    small.page.mouse.down()
    for x in range(130, 300, 15):
        small.page.mouse.move(x, 240)
        if x == 220:
            small.page.wait_for_timeout(1000)  # longer than two edits of a field may lie apart to be one
    small.page.mouse.up()
    drawn(small)
    whole, picture = touches(small), small.picture()
    assert len(whole) > 4
    # The address follows after a moment, and has those of the taps before.
    small.page.wait_for_function(
        "(all) => location.hash.match(/touches=([^&]*)/)?.[1].split(/~|%7E/).length === all", arg=len(whole)
    )
    fragment = small.page.url.partition("#")[2]
    small.page.locator("#canvas").focus()
    counts = []
    for _ in range(3):
        small.page.keyboard.press("Control+z")
        counts.append(len(touches(small)))
    assert counts == [2, 1, 0]
    small.follow(f"#preset=paper-halftone&{fragment}")
    assert touches(small) == whole
    assert (small.picture() == picture).all()


def test_keys_touch_and_choose_what_a_drag_does(small: Visit) -> None:
    button = small.page.get_by_role("button", name="Touch water")
    small.page.locator("#canvas").focus()
    small.page.keyboard.press("Enter")
    drawn(small)
    assert len(touches(small)) == 1
    small.page.keyboard.press("t")
    assert button.get_attribute("aria-pressed") == "false"
    yaw = small.state()["camera"]["yaw"]
    drag(small.page, (200, 200), (260, 200))
    small.page.wait_for_function("(yaw) => window.seafoam.state().camera.yaw !== yaw", arg=yaw)
    assert len(touches(small)) == 1
    small.page.keyboard.press("t")


def test_a_visitor_dives(lake: Visit) -> None:
    """Down through the surface by key, once that is compiled; an orbit alone stays over it."""
    lake.follow(link(preset="lake-calm", scene={"/light/exposure": 1.0}))
    over = lake.picture()
    keyboard = lake.page.keyboard
    drag(lake.page, (200, 150), (200, 20), button="right")
    lake.frames(6)
    assert lake.state()["camera"]["position"][1] > 0.0
    lake.page.locator("#canvas").focus()
    keyboard.down("q")
    lake.page.wait_for_function("() => window.seafoam.state().camera.position[1] < -0.4", timeout=60_000)
    keyboard.up("q")
    lake.frames(3)
    under = lake.picture()
    assert differs(under, over) > 0.9
    assert np.ptp(under.astype(int), axis=(0, 1)).max() > 8, "nothing to see"
    lake.settings()
    served, _ = lake.saved("Render on server")
    assert differs(served, under) < 1e-3


def test_the_camera_asks_for_nothing(lake: Visit) -> None:
    """Without inertia, so that the camera stands still between two moves; the server's streams would be asked for."""
    lake.follow(link(preset="lake-calm", time=2.0, draw="browser"))
    before, asked = lake.picture(), len(lake.asked)
    camera = lake.state()["camera"]
    mouse, keyboard = lake.page.mouse, lake.page.keyboard

    def moved(what: str) -> None:
        """The move has reached the camera, and is over."""
        nonlocal camera
        lake.page.wait_for_function(
            "([what, held]) => JSON.stringify(window.seafoam.state().camera[what]) !== JSON.stringify(held)",
            arg=[what, camera[what]],
        )
        if what == "position":
            assert lake.state()["camera"]["fov"] == camera["fov"]
        camera = lake.state()["camera"]

    drag(lake.page, (200, 150), (260, 150), button="right", steps=1)
    moved("yaw")
    mouse.wheel(0, -100)
    moved("position")
    keyboard.down("Shift")
    mouse.wheel(0, 100)
    keyboard.up("Shift")
    moved("fov")
    lake.page.locator("#canvas").focus()
    for key, what in (("w", "position"), ("ArrowLeft", "yaw")):
        keyboard.down(key)
        moved(what)
        keyboard.up(key)
        lake.frames(3)
        camera = lake.state()["camera"]
        lake.frames(3)
        assert lake.state()["camera"] == camera, "the camera stops with the key"
    assert differs(lake.picture(), before) > 0.2
    assert [url for _, url in lake.asked[asked:] if "/api/" in url and "width=192" not in url] == []


def test_edits_are_undone_redone_and_listed_and_a_look_alone_asks_for_a_plan(small: Visit) -> None:
    page = small.page
    # Of another water's edits none is undone.
    small.follow(link(preset="paper-threshold"))
    small.follow(link())
    before, asked = small.picture(), small.plans()
    small.type("exposure", "1", folder="light")
    bright = small.picture()
    assert bright.mean() > before.mean() + 10
    assert small.plans() == asked
    small.settings().get_by_label("look", exact=True).select_option(label="textured")
    both = [["/foam/look", "textured"], ["/light/exposure", 1]]
    assert small.state()["changes"] == both
    assert differs(small.picture(), bright) > 0.05
    assert small.plans() == asked + 1
    page.locator("#canvas").focus()
    page.keyboard.press("Control+z")
    assert small.state()["changes"] == both[1:]
    assert (small.picture() == bright).all()
    page.get_by_role("button", name="Undo").click()
    assert small.state()["changes"] == []
    assert (small.picture() == before).all()
    expect(page.get_by_role("button", name="Undo")).to_be_disabled()
    page.locator("#canvas").focus()
    page.keyboard.press("Control+Shift+z")
    assert small.state()["changes"] == both[1:]
    page.get_by_role("button", name="Redo").click()
    assert small.state()["changes"] == both
    expect(page.get_by_role("button", name="Redo")).to_be_disabled()
    page.locator(".changes summary").click()
    own = load_preset("paper-halftone").scene
    expect(page.locator(".changes li").first).to_contain_text(f"{own.foam.look} → textured")
    page.get_by_role("button", name="Revert /foam/look").click()
    assert small.state()["changes"] == both[1:]
    small.press("Reset scene")
    assert small.state()["changes"] == []
    assert (small.picture() == before).all()


def test_a_scene_is_copied_and_pasted_and_what_is_wrong_with_it_told(small: Visit) -> None:
    page = small.page
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    small.follow(link(scene={"/light/exposure": 1}))
    before = small.picture()
    small.settings()
    small.press("Copy scene")
    page.get_by_text("Scene copied").wait_for()
    own = load_preset("paper-halftone").scene.model_dump(mode="json")
    own["light"]["exposure"] = 1
    assert json.loads(page.evaluate("() => navigator.clipboard.readText()")) == own
    page.get_by_role("button", name="Paste scene").click()
    text, alert = page.get_by_label("Scene as JSON"), page.locator(".paste [role=alert]")
    apply = page.get_by_role("button", name="Apply")
    for wrong, said in (("{", "Not JSON"), ('{"light": {"exposure": 1000}}', "exposure")):
        text.fill(wrong)
        apply.click()
        expect(alert).to_contain_text(said)
    assert all("422" in said for said in small.complaints)
    small.complaints.clear()
    other = load_preset("paper-height").scene
    text.fill(json.dumps({"scene": other.model_dump(mode="json")}))
    apply.click()
    expect(text).to_have_count(0)
    assert small.state()["camera"]["position"] == list(other.camera.position)
    assert differs(small.picture(), before) > 0.5
