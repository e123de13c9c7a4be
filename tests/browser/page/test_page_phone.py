"""The page on a phone, what must be large enough on any screen; time and resolution."""

from collections.abc import Iterator

import pytest

from support.browser.visits import FINGER, PHONE, SMALL, TARGETS, Visit, differs, link, swipe


@pytest.fixture
def phone(shared_phone: Visit) -> Iterator[Visit]:
    """The page on a phone, at rest, as it was when it opened; it may complain of nothing."""
    with shared_phone.awake():
        shared_phone.start_again()
        yield shared_phone
    assert shared_phone.complaints == []


def test_fingers_touch_and_move_the_camera(phone: Visit) -> None:
    before, start = phone.picture(), phone.state()["camera"]
    swipe(phone.page, ((6, 560), (200, 560)))
    assert not phone.state()["touches"], "a swipe from the edge is the browser's"
    swipe(phone.page, ((120, 500), (40, 540)), ((260, 500), (350, 540)))
    phone.settle()
    closer = phone.state()["camera"]
    assert closer["position"] != start["position"]
    assert not phone.state()["touches"]
    phone.page.touchscreen.tap(200, 520)
    phone.page.wait_for_function("() => window.seafoam.state().touches?.length === 1 && !window.seafoam.state().busy")
    assert phone.state()["camera"] == closer
    phone.press("Touch water")
    asked = phone.plans()
    swipe(phone.page, ((100, 400), (220, 400)))
    phone.settle()
    turned = phone.state()["camera"]
    # The sea stays under the finger, so the view turns the other way.
    assert turned["yaw"] < closer["yaw"] - 0.05
    assert turned["fov"] == start["fov"]
    assert differs(phone.picture(), before) > 0.2
    assert phone.plans() == asked
    phone.press("Touch water")


def test_the_settings_are_a_sheet_from_below(phone: Visit) -> None:
    panel = phone.settings()
    phone.page.wait_for_function("() => getComputedStyle(document.querySelector('#settings')).transform === 'none'")
    box = panel.bounding_box()
    assert (box["x"], box["width"]) == (0, PHONE[0])
    assert box["y"] + box["height"] == pytest.approx(PHONE[1], abs=1)
    assert box["y"] > PHONE[1] / 3, "no picture is left to judge by"
    play = phone.page.get_by_role("button", name="Play")
    play.click()
    assert phone.state()["playing"] is True, "time stays in reach"
    phone.press("Pause")
    assert phone.page.evaluate("() => document.documentElement.scrollWidth - innerWidth") <= 0
    phone.press("Close settings")
    phone.page.wait_for_function("() => getComputedStyle(document.querySelector('#settings')).visibility === 'hidden'")
    assert panel.evaluate("(panel) => panel.inert") is True


COVERED = """(within) => [...document.querySelectorAll(within)].flatMap((part) =>
  [...part.querySelectorAll('button, select, input, [role=slider]')]
    .filter((target) => target.checkVisibility({ checkVisibilityCSS: true }))
    .filter((target) => {
      const { x, y, width, height } = target.getBoundingClientRect();
      const top = document.elementFromPoint(x + width / 2, y + height / 2);
      return !target.contains(top);
    })
    .map((target) => target.getAttribute('aria-label')))"""
"""Names of what cannot be hit in the parts that a selector names."""


def test_targets_fit_a_finger_and_nothing_covers_them(phone: Visit) -> None:
    page = phone.page
    phone.press("Compare side by side")
    targets = page.evaluate(TARGETS)
    assert page.evaluate(COVERED, "#transport, #tools, #split-view") == []
    phone.settings()
    for folder in ("light", "waves (2)"):
        phone.settings().get_by_role("button", name=folder).click()
    phone.still()
    targets += page.evaluate(TARGETS)
    assert page.evaluate(COVERED, "#settings .head, #transport") == []
    assert len(targets) > 40
    assert [target for target in targets if min(target[1:]) < FINGER] == []


def test_the_resolution_is_fixed_and_set_free(small: Visit) -> None:
    width, height = SMALL
    small.settings().get_by_label("resolution").select_option("0.5")
    small.settle()
    timing = small.state()["timing"]
    assert (timing["width"], timing["height"], timing["scale"]) == (width // 2, height // 2, 0.5)
    small.page.wait_for_function("() => location.hash.includes('scale=0.5')")
    small.settings().get_by_label("resolution").select_option("auto")
    small.settle()
    # At rest it grows as sharp as the window.
    assert small.state()["timing"]["width"] == width
    small.page.wait_for_function("() => !location.hash.includes('scale')")


def test_a_pause_stops_every_pixel_and_time_is_typed_exactly_and_steps_by_frames(small: Visit) -> None:
    page, before, time = small.page, small.canvas(), small.state()["time"]
    small.frames(12)
    assert (small.canvas() == before).all()
    assert small.state()["time"] == time
    small.press("Play")
    page.wait_for_function("(time) => window.seafoam.state().time > time", arg=time + 0.5)
    page.locator("#canvas").press("Space")
    small.settle()
    assert small.state()["playing"] is False
    assert differs(small.canvas(), before) > 0.2
    small.press("Reset time")
    assert small.state()["time"] == time
    page.get_by_label("Time within the minute").fill("30")
    assert small.state()["time"] == pytest.approx(30.0, abs=1e-6)
    moment = page.get_by_label("Time in seconds")
    for typed, time in (("-12.5", -12.5), ("1e9", 1e9), ("4,25", 4.25), ("never", 4.25)):
        small.enter("Time in seconds", typed)
        assert small.state()["time"] == time
    assert small.picture().std() > 5.0
    small.follow(link(time=1))
    page.locator("#canvas").press(".")
    assert small.state()["time"] == 61 / 60
    moment.focus()
    assert float(moment.input_value()) == 61 / 60, "the field shows every digit while it is edited"
    # In the field these keys are text.
    moment.fill("")
    moment.type("4.25")
    moment.press("Enter")
    assert small.state()["time"] == 4.25
