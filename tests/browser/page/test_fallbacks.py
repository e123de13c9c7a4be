"""Where something is missing or goes away: an extension, a renderer, its context, the server, a preset."""

import numpy as np
import pytest
from numpy.typing import NDArray
from playwright.sync_api import Error

from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from support.browser.lanes import Lane, rendered
from support.browser.visits import BLANK, Visit, link, visit
from support.exact import UNFILTERED
from support.pictures import draw
from support.scenes import load_preset
from support.sweep import spread

SIZE = (400, 300)
REFUSED = "ERR_CONNECTION_REFUSED"
FLOATS = "OES_texture_float_linear,OES_texture_half_float_linear,EXT_float_blend,EXT_color_buffer_float"
HIDDEN = (
    FLOATS,
    *FLOATS.split(","),
    "EXT_color_buffer_half_float",
    "KHR_parallel_shader_compile",
    "EXT_disjoint_timer_query_webgl2,WEBGL_debug_renderer_info",
    "WEBGL_lose_context",
)
"""Extensions."""


@pytest.mark.parametrize("hidden", spread(HIDDEN, len(HIDDEN)))
def test_draws_without(llvmpipe: Lane, server: str, executor: Executor, hidden: str) -> None:
    """The server's pixels; where a float32 target cannot be had that is asked for, a word."""
    scene, size = load_preset("default").scene, (48, 27)
    with visit(llvmpipe, server, f"?hide={hidden}{link(preset='default')}", size=SIZE) as made:
        assert made.picture().std() > 5.0
        assert made.page.locator(".toast").count() == 0
        for quality in (TIERS["standard"], UNFILTERED):
            plan = make_plan(scene, quality)
            if "EXT_color_buffer_float" in hidden and quality is UNFILTERED:
                with pytest.raises(Error, match="EXT_color_buffer_float"):
                    rendered(made.page, plan, time=2.7, size=size, camera=scene.camera)
                continue
            drawn = rendered(made.page, plan, time=2.7, size=size, camera=scene.camera).astype(int)
            assert np.abs(drawn - draw(executor, plan, scene.camera, time=2.7, size=size)).max() <= 1


def test_the_server_draws_where_no_picture_can_be_drawn(llvmpipe: Lane, server: str) -> None:
    address = f"?hide=EXT_color_buffer_float,EXT_color_buffer_half_float{link()}"
    with visit(llvmpipe, server, address, size=SIZE) as made:
        notice = made.page.locator("#heading .notice").inner_text()
        assert "EXT_color_buffer_float" in notice
        assert made.canvas().std() > 5.0


def test_it_says_so_while_the_server_is_away_and_the_picture_stays_when_it_goes(llvmpipe: Lane, server: str) -> None:
    with visit(llvmpipe, server, BLANK, size=SIZE, settle=False) as made:
        # The browser notes each request that failed; the page itself has nothing to complain of.
        made.expected = REFUSED
        made.page.route("**/api/**", lambda route: route.abort("connectionrefused"))
        made.page.goto(f"{server}/{link()}")
        failure = made.page.locator("#loading .failure")
        failure.wait_for()
        assert "Server not reachable" in failure.inner_text()
        made.page.unroute("**/api/**")
        made.press("Reload page")
        made.settle()
        before = made.picture()
        assert before.std() > 5.0
        made.page.route("**/api/**", lambda route: route.abort("connectionrefused"))
        made.follow(link(scene={"/foam/look": "textured"}))
        made.page.locator(".toast.error", has_text="does not respond").wait_for()
        assert not made.page.locator("#loading").is_visible()
        assert (made.picture() == before).all()
        # Once it is back, the same choice is asked for again.
        made.page.unroute("**/api/**")
        made.follow(link(scene={"/foam/look": "filtered"}))
        assert (made.picture() != before).any()


def test_links_that_ask_for_nonsense_or_are_cut_short_still_open(llvmpipe: Lane, server: str) -> None:
    fragment = link(preset="atlantis", scene={"/foam/look": "textured"}, time=77)
    with visit(llvmpipe, server, f"#%&{fragment[1:]}", size=SIZE) as made:
        error = made.page.locator(".toast.error")
        assert "atlantis" in error.inner_text()
        assert made.state()["preset"] == "default"
        assert made.state()["changes"] == [], "what a link says of one sea means nothing for another"
        assert made.page.locator("#title").text_content() == load_preset("default").title
        made.follow(f"#%&camera=1,2&split=~~&time=soon&{link()[1:]}")
        assert made.state()["preset"] == "paper-halftone"
        assert made.picture().std() > 5.0
        made.expected = "422"
        for nonsense in ({"scene": {"/waves": "flat"}}, {"quality": "best"}):
            made.page.goto(BLANK)
            made.page.goto(f"{server}/{link(**nonsense)}")
            made.settle()
            error.first.wait_for()
            assert made.picture().std() > 5.0
            assert made.state()["changes"] == []


def drawn(made: Visit) -> NDArray[np.uint8]:
    return rendered(made.page, "paper-halftone", time=2.7, size=(160, 90), quality="fast")


def lose(made: Visit) -> None:
    made.page.evaluate("() => window.seafoam.loseContext()")
    made.page.wait_for_function("() => window.seafoam.state().lost")
    # The event that the page must hear comes later, in a task of its own.
    made.page.locator(".toast", has_text="WebGL context lost").wait_for()


def restore(made: Visit) -> None:
    made.page.evaluate("() => window.seafoam.restoreContext()")
    made.page.wait_for_function("() => !window.seafoam.state().lost && window.seafoam.state().pictures > 0")
    made.settle()


def test_the_picture_comes_back_and_choices_made_meanwhile_are_drawn(llvmpipe: Lane, server: str) -> None:
    kept = ("camera", "time", "changes", "split")
    at = {"preset": "paper-halftone", "time": 2.7}
    with visit(llvmpipe, server, link(**at), size=SIZE) as made:
        for parts in ({}, {"split": "/foam/look~textured~halftone~0.400"}):
            made.follow(link(**at, **parts))
            frame, canvas, asked = drawn(made), made.picture(), made.state()
            assert frame[..., :3].std() > 5.0
            assert canvas.std() > 5.0
            # Once more with what is made anew.
            for _ in range(2):
                lose(made)
                restore(made)
                now = made.state()
                assert now["pictures"] == (2 if parts else 1)
                assert (made.picture() == canvas).all()
                assert (drawn(made) == frame).all()
                assert [now[key] for key in kept] == [asked[key] for key in kept]
        textured = link(**at, scene={"/foam/look": "textured"})
        made.follow(textured)
        want = made.picture()
        made.follow(link(**at))
        assert (made.picture() != want).any()
        lose(made)
        made.page.evaluate("(fragment) => { location.hash = fragment; }", textured)
        made.frames(3)
        restore(made)
        assert (made.picture() == want).all()
