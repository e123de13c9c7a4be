"""What a visitor sees while nothing arrives, on a slow network."""

from playwright.sync_api import expect

from support.browsers import Lane
from support.visits import SMALL, Held, Visit, link, visit

PLANS = "**/api/plans"


def test_on_a_slow_network_the_still_stands_until_the_plan_is_here(llvmpipe: Lane, server: str) -> None:
    with visit(llvmpipe, server, "icon.svg", size=SMALL, settle=False, reduced_motion="reduce") as made:
        page, held = made.page, Held(made.page, PLANS)
        page.goto(f"{server}/#paused=1&quality=draft")
        page.locator("#title", has_text="Evening swell").wait_for()
        expect(page.locator("#still")).to_be_visible()
        expect(page.locator("#loading")).to_be_hidden()
        made.settings()
        expect(page.locator(".busy")).to_be_visible()
        held.let_go()
        made.settle()
        expect(page.locator(".busy")).to_be_hidden()
        expect(page.locator("#still")).to_be_hidden()
        assert made.canvas().std() > 5.0


def test_the_picture_stays_on_a_slow_network_and_the_last_choice_counts(small: Visit) -> None:
    page, before = small.page, small.picture()
    held = Held(page, PLANS)
    for look in ("textured", "halftone"):
        page.evaluate("(hash) => { location.hash = hash; }", link(scene={"/foam/look": look}))
        page.wait_for_function("() => window.seafoam.state().busy")
        page.wait_for_timeout(300)  # longer than the page waits for a slider to come to rest
    assert (small.saved()[0] == before).all()
    held.let_go()
    page.wait_for_function("() => !window.seafoam.state().busy")
    halftone = small.picture()
    small.follow(link(scene={"/foam/look": "halftone"}))
    assert (small.picture() == halftone).all()
    assert (halftone != before).any()
