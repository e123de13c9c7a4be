"""Without WebGL 2 the server draws, and the page works as it does with it."""

from collections.abc import Iterator

import pytest
from playwright.sync_api import Route, expect

from support.browser.lanes import Lane
from support.browser.visits import BLANK, Held, Pixels, Visit, canvas_pixels, link, pixels_of, visit

SIZE = (400, 300)
NO_WEBGL = """
const open = HTMLCanvasElement.prototype.getContext;
HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
  return kind === 'webgl2' ? null : open.call(this, kind, ...rest);
};
"""
ADDRESS = link(preset="paper-threshold", time=1.0)
FRAMES = "**/api/frames"


@pytest.fixture(scope="module")
def shared_served(llvmpipe: Lane, server: str) -> Iterator[Visit]:
    with visit(llvmpipe, server, BLANK, size=SIZE, settle=False, reduced_motion="reduce") as made:
        made.page.add_init_script(NO_WEBGL)
        made.page.goto(f"{server}/{ADDRESS}")
        made.settle()
        yield made


@pytest.fixture
def served(shared_served: Visit) -> Visit:
    """A page whose browser has no WebGL 2, paused."""
    shared_served.start_again(ADDRESS)
    return shared_served


def shown(made: Visit) -> Pixels:
    """The frame that the page shows, as the server sent it."""
    made.settle()
    return canvas_pixels(made.page.locator(".served canvas").last)


def test_the_servers_frame_stands_in_the_canvass_place(served: Visit, server: str) -> None:
    page = served.page
    notice = page.locator("#heading .notice")
    expect(notice).to_have_text("The server draws the frames. WebGL 2 is not available or is disabled in this browser.")
    query = f"quality=fast&time=1&width={SIZE[0]}&height={SIZE[1]}"
    reply = page.request.get(f"{server}/api/frames/paper-threshold.png?{query}")
    want = pixels_of(reply.body())
    assert (shown(served) == want).all()
    box = page.locator(".served canvas").bounding_box()
    assert box == {"x": 0, "y": 0, "width": SIZE[0], "height": SIZE[1]}
    expect(page.locator(".frame-stats")).to_contain_text("server")
    saved, _ = served.saved()
    exact = page.request.get(f"{server}/api/frames/paper-threshold.png?{query}&dither=false")
    assert (saved == pixels_of(exact.body())).all()
    expect(page.get_by_role("button", name="Accuracy benchmark")).to_have_count(0)


def test_time_camera_settings_and_presets_work(served: Visit) -> None:
    page = served.page
    pictures = [shown(served)]

    def changed() -> None:
        pictures.append(shown(served))
        assert (pictures[-1].shape != pictures[-2].shape) or (pictures[-1] != pictures[-2]).any()

    served.enter("Time in seconds", "2.5")
    changed()
    page.get_by_role("button", name="Play").click()
    page.wait_for_function("() => window.seafoam.state().timing.frames > 4 && window.seafoam.state().time > 2.6")
    page.get_by_role("button", name="Pause").click()
    changed()
    yaw = served.state()["camera"]["yaw"]
    page.locator("#canvas").focus()
    page.keyboard.down("ArrowLeft")
    page.wait_for_function("(yaw) => window.seafoam.state().camera.yaw !== yaw", arg=yaw)
    page.keyboard.up("ArrowLeft")
    changed()
    served.settings().get_by_label("field of view").fill("80")
    changed()
    served.settings().get_by_label("mask", exact=True).select_option(index=2)
    changed()
    page.get_by_role("button", name="Close settings").click()
    served.follow(link(time=1.0))
    changed()
    expect(page.locator("#title")).not_to_have_text("")
    assert served.state()["preset"] == "paper-halftone"


def test_two_looks_are_compared(served: Visit) -> None:
    page = served.page
    served.follow(link(preset="paper-threshold", time=1.0, split="/foam/mask~vac-3~vac-24~0.400"))
    served.settle()
    expect(page.locator(".served canvas")).to_have_count(2)
    right = page.locator(".served canvas").last
    assert right.evaluate("(image) => getComputedStyle(image).clipPath") == "inset(0px 0px 0px 40%)"
    asked = served.frames_asked()
    page.get_by_role("slider", name="Split position").press("ArrowRight")
    served.settle()
    expect(right).to_have_css("clip-path", "inset(0px 0px 0px 42%)")
    assert served.frames_asked() == asked, "the divider cuts the pictures that are here"


def test_one_request_at_a_time_and_the_newest_view_next(served: Visit) -> None:
    """While a frame is awaited, views that come and go are not asked for."""
    page = served.page
    held = Held(page, FRAMES)
    for time in (2, 3, 4, 5):
        served.enter("Time in seconds", str(time))
        served.frames(5)
    assert [body["time"] for body in held.bodies()] == [2]
    held.let_go(holding=True)
    held.arrived()
    assert [body["time"] for body in held.bodies()] == [5]
    held.let_go()
    served.settle()


def test_the_picture_stays_while_the_server_is_away(served: Visit) -> None:
    page = served.page
    before = shown(served)
    failed: list[int] = []

    def refuse(route: Route) -> None:
        failed.append(1)
        route.abort("connectionrefused")

    page.route(FRAMES, refuse)
    served.enter("Time in seconds", "2.5")
    page.locator(".toast.error", has_text="does not respond").wait_for()
    page.wait_for_timeout(1500)
    assert 1 <= len(failed) < 5, "it is asked again, not at every frame"
    expect(page.locator(".toast.error")).to_have_count(1)
    expect(page.locator("#loading")).to_be_hidden()
    image = page.locator(".served canvas")
    expect(image).to_have_count(1)
    page.unroute(FRAMES)
    assert (shown(served) != before).any(), "it comes back by itself"
    assert all("ERR_CONNECTION_REFUSED" in complaint for complaint in served.complaints)
    served.complaints.clear()
