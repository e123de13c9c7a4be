"""The graphics driver takes the context away and gives it back: the picture comes back, the same."""

import numpy as np
import pytest
from numpy.typing import NDArray

from support.browser.lanes import Lane, rendered
from support.browser.visits import STILL, Visit, link, visit


def drawn(made: Visit) -> NDArray[np.uint8]:
    return rendered(made.page, "default", time=2.7, size=(160, 90), quality="fast")


def lose(made: Visit) -> None:
    made.page.evaluate("() => window.seafoam.loseContext()")
    made.page.wait_for_function("() => window.seafoam.state().lost")
    # The event that the page must hear comes later, in a task of its own.
    made.page.locator(".toast", has_text="WebGL context lost").wait_for()


def restore(made: Visit) -> None:
    made.page.evaluate("() => window.seafoam.restoreContext()")
    made.page.wait_for_function("() => !window.seafoam.state().lost && window.seafoam.state().pictures > 0")


@pytest.mark.parametrize("split", [False, True], ids=["one picture", "two pictures"])
def test_the_picture_comes_back(llvmpipe: Lane, server: str, split: bool) -> None:
    parts = {"split": "/foam/look~textured~halftone~0.400"} if split else {}
    with visit(llvmpipe, server, link(time=2.7, **parts), size=(400, 300)) as made:
        frame, canvas = drawn(made), made.picture()
        assert frame[..., :3].std() > 5.0
        assert canvas.std() > 5.0
        asked = made.state()
        for _ in range(2):
            lose(made)
            restore(made)
            made.settle()
            assert made.page.evaluate("() => window.seafoam.state().pictures") == (2 if split else 1)
            assert (made.picture() == canvas).all()
            assert (drawn(made) == frame).all()
        now = made.state()
        assert {key: now[key] for key in ("camera", "time", "changes", "split")} == {
            key: asked[key] for key in ("camera", "time", "changes", "split")
        }


def test_choices_made_meanwhile_are_drawn(llvmpipe: Lane, server: str) -> None:
    with visit(llvmpipe, server, STILL, size=(400, 300)) as made:
        made.follow(link(scene={"/foam/look": "textured"}))
        want = made.picture()
        made.follow(STILL)
        assert (made.picture() != want).any()
        lose(made)
        made.page.evaluate("(fragment) => { location.hash = fragment; }", link(scene={"/foam/look": "textured"}))
        made.frames(3)
        restore(made)
        made.settle()
        assert (made.picture() == want).all()
