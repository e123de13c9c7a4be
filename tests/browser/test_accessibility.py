"""What axe finds wrong with the page and its parts for people who use a keyboard or a screen reader."""

from pathlib import Path
from typing import Any

import pytest

from support.browsers import Lane
from support.visits import DESKTOP, PHONE, Visit, link, visit

AXE = Path(__file__).parents[2] / "webclient/node_modules/axe-core/axe.min.js"


def violations(made: Visit) -> list[Any]:
    """Rule and places of all that axe finds in what is in sight."""
    # Colours are judged once nothing fades any more; the name on the hidden loading screen pulses for ever.
    made.page.wait_for_function(
        "() => document.getAnimations().every(({ effect, playState }) =>"
        " playState !== 'running' || effect.getTiming().iterations === Infinity)"
    )
    made.page.evaluate(AXE.read_text(encoding="utf-8"))
    found: list[Any] = made.page.evaluate(
        "async () => (await axe.run()).violations"
        ".map(({ id, nodes }) => [id, nodes.map(({ html }) => html.slice(0, 120))])"
    )
    return found


@pytest.mark.parametrize("size", [DESKTOP, PHONE], ids=["desktop", "phone"])
def test_axe_finds_nothing(llvmpipe: Lane, server: str, size: tuple[int, int]) -> None:
    with visit(llvmpipe, server, link(scene={"/light/exposure": 1}), size=size, reduced_motion="reduce") as made:
        page = made.page
        assert violations(made) == [], "the page"
        page.keyboard.press("/")
        page.locator(".waters").wait_for()
        assert violations(made) == [], "the list of waters"
        page.keyboard.press("Escape")
        made.settings().get_by_role("button", name="light", exact=True).click()
        page.get_by_role("button", name="Paste scene").click()
        page.locator(".changes summary").click()
        assert violations(made) == [], "the settings"


def test_axe_would_find_something(llvmpipe: Lane, server: str) -> None:
    with visit(llvmpipe, server) as made:
        made.page.evaluate("() => document.querySelector('#tools button').removeAttribute('aria-label')")
        made.page.evaluate("() => document.querySelector('#tools button').removeAttribute('title')")
        assert [rule for rule, _ in violations(made)] == ["button-name"]
