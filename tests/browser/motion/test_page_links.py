"""What the page keeps and gives: links that restore a view, files, and what asks for a plan."""

import pytest

from support.browser.lanes import Lane
from support.browser.visits import Visit, differs, drag, link, visit
from support.scenes import load_preset

# Links and files


def test_a_link_restores_everything(llvmpipe: Lane, server: str) -> None:
    permissions = ["clipboard-read", "clipboard-write"]
    changes = {"/foam/mask_tile": 3.5, "/light/exposure": -0.75}
    start = link(preset="paper-halftone", time=4.1234567890123, scene=changes)
    size = (400, 300)
    with visit(llvmpipe, server, start, size=size, permissions=permissions) as made:
        made.page.mouse.move(100, 140)
        made.page.mouse.wheel(0, -120)
        made.page.get_by_label("Speed", exact=True).select_option("0.5")
        made.press("Compare side by side")
        handle = made.page.locator("#split-view .handle")
        handle.wait_for()  # What is not in sight yet takes no key, and says nothing of it.
        handle.press("ArrowLeft")
        first = made.picture()
        made.press("Copy link to this view")
        made.page.get_by_text("Link copied").wait_for()
        address = made.page.evaluate("() => navigator.clipboard.readText()")
        state = made.state()
        assert address == made.page.url
    assert dict(state["changes"]) == changes
    assert state["split"]["at"] == pytest.approx(0.48)
    assert state["camera"]["position"] != list(load_preset("paper-halftone").scene.camera.position)
    with visit(llvmpipe, server, address.removeprefix(f"{server}/"), size=size) as made:
        second, again = made.picture(), made.state()
    for told in (state, again):
        del told["timing"], told["settled"]
    assert again == state
    assert (second == first).all()


@pytest.mark.parametrize("ratio", [1, 2])
def test_the_png_is_the_canvas(llvmpipe: Lane, server: str, ratio: int) -> None:
    with visit(llvmpipe, server, link(time=3.25), size=(400, 300), device_scale_factor=ratio) as made:
        pixels, name = made.saved()
        assert pixels.shape == (300 * ratio, 400 * ratio, 3)
        assert pixels.std() > 5.0
        assert name == "seafoam-default-3.25s.png"


# What asks for a plan, and what does not


def test_a_live_field_asks_for_nothing_and_a_look_for_a_plan(small: Visit) -> None:
    before, asked = small.picture(), small.plans()
    small.type("exposure", "1", folder="light")
    brighter = small.picture()
    assert brighter.mean() > before.mean() + 10
    assert small.plans() == asked
    small.settings().get_by_label("look", exact=True).select_option(label="halftone")
    assert differs(small.picture(), brighter) > 0.05
    assert small.plans() == asked + 1
    small.press("Reset scene")
    assert (small.picture() == before).all()


def test_the_camera_asks_for_nothing(llvmpipe: Lane, server: str) -> None:
    # Without inertia the camera stands still between two moves.
    with visit(llvmpipe, server, size=(400, 300), reduced_motion="reduce") as made:
        before, asked = made.picture(), len(made.asked)
        camera = made.state()["camera"]
        mouse, keyboard = made.page.mouse, made.page.keyboard

        def moved(what: str) -> None:
            """The move has reached the camera, and is over."""
            nonlocal camera
            made.page.wait_for_function(
                "([what, held]) => JSON.stringify(window.seafoam.state().camera[what]) !== JSON.stringify(held)",
                arg=[what, camera[what]],
            )
            if what == "position":
                assert made.state()["camera"]["fov"] == camera["fov"]
            camera = made.state()["camera"]

        drag(made.page, (200, 150), (260, 150), button="right", steps=1)
        moved("yaw")
        mouse.wheel(0, -100)
        moved("position")
        keyboard.down("Shift")
        mouse.wheel(0, 100)
        keyboard.up("Shift")
        moved("fov")
        made.page.locator("#canvas").focus()
        for key, what in (("w", "position"), ("d", "position"), ("e", "position"), ("ArrowLeft", "yaw")):
            keyboard.down(key)
            moved(what)
            keyboard.up(key)
            made.frames(3)
            camera = made.state()["camera"]
            made.frames(3)
            assert made.state()["camera"] == camera, "the camera stops with the key"
        assert differs(made.picture(), before) > 0.2
        assert [url for _, url in made.asked[asked:] if "/api/" in url and "width=192" not in url] == []


def test_a_bad_value_is_told_and_the_picture_stays(small: Visit) -> None:
    # A moment at which foam covers much of the view.
    small.follow(link(time=13.0))
    before = small.picture()
    small.page.evaluate(
        "(fragment) => { location.hash = fragment; }", link(time=13.0, scene={"/foam/mask": "no-such-mask"})
    )
    toast = small.page.locator(".toast.error")
    toast.wait_for()
    assert "mask" in (toast.text_content() or "")
    assert (small.picture() == before).all()
    # The browser itself notes a refused request.
    assert all("422" in said for said in small.complaints)
    small.complaints.clear()
    small.follow(link(time=13.0, scene={"/foam/mask": "vac-6"}))
    assert differs(small.picture(), before) > 0.05
