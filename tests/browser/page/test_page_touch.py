"""Touching the water on the page, and edits of the scene: taps, drags, fingers; undone, compared, copied, pasted."""

import json
from collections.abc import Iterator

import numpy as np
import pytest
from playwright.sync_api import expect

from support.browser.lanes import Lane
from support.browser.visits import PHONE, Visit, differs, drag, link, swipe, visit
from support.scenes import load_preset

SIZE = (560, 360)
LAKE = link(preset="lake-calm", time=2.0)


@pytest.fixture(scope="module")
def shared_lake(llvmpipe: Lane, server: str) -> Iterator[Visit]:
    with visit(llvmpipe, server, LAKE, size=SIZE, reduced_motion="reduce") as made:
        yield made


@pytest.fixture
def lake(shared_lake: Visit) -> Visit:
    """A still lake, paused, as nobody has touched it."""
    shared_lake.start_again(LAKE)
    return shared_lake


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


def test_a_drag_leaves_a_train_that_a_link_restores(lake: Visit, llvmpipe: Lane, server: str) -> None:
    drag(lake.page, (120, 240), *((x, 240 + x // 20) for x in range(130, 440, 15)), steps=1)
    drawn(lake)
    made = touches(lake)
    steps = np.hypot(*np.diff([[one["x"], one["z"]] for one in made], axis=0).T)
    assert len(made) > 5
    assert steps.max() < 1.1 * steps.min()
    picture = lake.picture()
    lake.page.wait_for_function("() => location.hash.includes('touches=')")
    address = lake.page.url
    assert len(address.partition("#")[2]) <= 2000
    with visit(llvmpipe, server, address.removeprefix(f"{server}/"), size=SIZE, reduced_motion="reduce") as again:
        assert touches(again) == made
        assert (again.picture() == picture).all()


def test_a_tap_and_a_drag_are_a_step_of_undo_each(lake: Visit) -> None:
    """Two taps at once, as fast as they come while the first plan is made, and a slow drag: three steps."""
    for x in (200, 360):
        lake.page.mouse.click(x, 260)
    drawn(lake)
    lake.page.mouse.move(120, 240)
    lake.page.mouse.down()
    for x in range(130, 300, 15):
        lake.page.mouse.move(x, 240)
        if x == 220:
            lake.page.wait_for_timeout(1000)  # longer than two edits of a field may lie apart to be one
    lake.page.mouse.up()
    drawn(lake)
    whole = touches(lake)
    assert len(whole) > 4
    lake.page.locator("#canvas").focus()
    counts = []
    for _ in range(3):
        lake.page.keyboard.press("Control+z")
        counts.append(len(touches(lake)))
    assert counts == [2, 1, 0]
    for _ in range(3):
        lake.page.keyboard.press("Control+y")
    assert touches(lake) == whole


def test_keys_touch_and_choose_what_a_drag_does(lake: Visit) -> None:
    button = lake.page.get_by_role("button", name="Touch water")
    assert button.get_attribute("aria-pressed") == "true"
    lake.page.locator("#canvas").focus()
    lake.page.keyboard.press("Enter")
    drawn(lake)
    assert len(touches(lake)) == 1
    lake.page.keyboard.press("t")
    assert button.get_attribute("aria-pressed") == "false"
    before = lake.state()["camera"]
    drag(lake.page, (200, 200), (260, 200))
    lake.page.wait_for_function("(yaw) => window.seafoam.state().camera.yaw !== yaw", arg=before["yaw"])
    assert len(touches(lake)) == 1
    lake.page.keyboard.press("t")


def test_rings_begin_when_they_can_be_seen(llvmpipe: Lane, server: str) -> None:
    """The first touch waits for its plan: no ring has died away before it is drawn."""
    with visit(llvmpipe, server, link(preset="lake-calm", time=2.0, scale=0.1), size=SIZE) as made:
        made.press("Play")
        made.page.mouse.click(300, 250)
        touched = made.state()["time"]
        made.page.wait_for_function("() => window.seafoam.state().touches !== null && !window.seafoam.state().busy")
        made.press("Pause")
        (ring,) = touches(made)
        assert touched - 0.02 <= ring["time"] <= made.state()["time"]


def test_fingers_touch_and_two_move_the_camera(llvmpipe: Lane, server: str) -> None:
    with visit(llvmpipe, server, LAKE, size=PHONE, has_touch=True, is_mobile=True, reduced_motion="reduce") as made:
        start = made.state()["camera"]
        swipe(made.page, ((6, 560), (200, 560)))
        assert touches(made) == [], "a swipe from the edge is the browser's"
        swipe(made.page, ((120, 500), (40, 540)), ((260, 500), (350, 540)))
        made.settle()
        turned = made.state()["camera"]
        assert turned["position"] != start["position"]
        assert touches(made) == []
        made.page.touchscreen.tap(200, 520)
        drawn(made)
        assert len(touches(made)) == 1
        assert made.state()["camera"] == turned


def test_a_picture_without_light_says_why_it_shows_no_rings(llvmpipe: Lane, server: str) -> None:
    with visit(llvmpipe, server, link(preset="paper-threshold"), size=SIZE) as made:
        before = made.picture()
        made.page.mouse.click(300, 250)
        toast = made.page.locator(".toast")
        toast.wait_for()
        assert "no light" in (toast.text_content() or "")
        assert touches(made) == []
        assert (made.picture() == before).all()


def test_edits_are_undone_and_redone(small: Visit) -> None:
    page = small.page
    before = small.picture()
    small.type("exposure", "1", folder="light")
    bright = small.picture()
    small.settings().get_by_label("look", exact=True).select_option(label="halftone")
    both = [["/foam/look", "halftone"], ["/light/exposure", 1]]
    assert small.state()["changes"] == both
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


def test_changes_are_listed_and_reverted_one_by_one(small: Visit) -> None:
    page = small.page
    small.follow(link(scene={"/light/exposure": 1, "/foam/look": "textured"}))
    small.settings()
    summary = page.locator(".changes summary")
    expect(summary).to_have_text("2 changed from the preset")
    summary.click()
    own = load_preset("default").scene
    rows = page.locator(".changes li")
    expect(rows.nth(0)).to_contain_text(f"{own.foam.look} → textured")
    expect(rows.nth(1)).to_contain_text("→ 1")
    page.get_by_role("button", name="Revert /foam/look").click()
    assert small.state()["changes"] == [["/light/exposure", 1]]
    page.get_by_role("button", name="Revert /light/exposure").click()
    expect(summary).to_have_text("no change from the preset")
    page.get_by_role("button", name="Undo").click()
    assert small.state()["changes"] == [["/light/exposure", 1]]


def test_a_scene_is_pasted_and_what_is_wrong_with_it_told(small: Visit) -> None:
    page = small.page
    before = small.picture()
    small.settings()
    page.get_by_role("button", name="Paste scene").click()
    text, alert = page.get_by_label("Scene as JSON"), page.locator(".paste [role=alert]")
    apply = page.get_by_role("button", name="Apply")
    expect(apply).to_be_disabled()
    text.fill("{")
    apply.click()
    expect(alert).to_contain_text("Not JSON")
    text.fill('{"light": {"exposure": 1000}}')
    apply.click()
    expect(alert).to_contain_text("exposure")
    assert small.state()["changes"] == []
    assert all("422" in said for said in small.complaints)
    small.complaints.clear()
    storm = load_preset("storm").scene
    text.fill(json.dumps({"scene": storm.model_dump(mode="json")}))
    apply.click()
    expect(text).to_have_count(0)
    assert small.state()["camera"]["position"] == list(storm.camera.position)
    assert differs(small.picture(), before) > 0.5
    page.get_by_role("button", name="Undo").click()
    assert small.state()["changes"] == []


@pytest.mark.parametrize("permissions", [["clipboard-read", "clipboard-write"]])
def test_a_scene_is_copied_whole(llvmpipe: Lane, server: str, permissions: list[str]) -> None:
    with visit(llvmpipe, server, link(scene={"/light/exposure": 1}), permissions=permissions) as made:
        made.settings()
        made.press("Copy scene")
        made.page.get_by_text("Scene copied").wait_for()
        copied = json.loads(made.page.evaluate("() => navigator.clipboard.readText()"))
        own = load_preset("default").scene.model_dump(mode="json")
        own["light"]["exposure"] = 1
        assert copied == own
