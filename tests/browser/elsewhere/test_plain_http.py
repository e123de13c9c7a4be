"""Pages over plain HTTP at a name, to which browsers give no clipboard and no ``crypto.randomUUID``."""

from collections.abc import Iterator
from urllib.parse import urlsplit

import pytest
from playwright.sync_api import Page, Playwright, expect
from test_notebook_page import Cell

from seafoam.notebook import Water
from support.browser.lanes import COMMON, LANES, Lane, chromium
from support.browser.visits import visit

HOST = "seafoam.test"


@pytest.fixture(scope="module")
def plain(playwright: Playwright) -> Iterator[Lane]:
    arguments = [
        *COMMON,
        *LANES["llvmpipe"],
        "--disable-gpu-compositing",
        f"--host-resolver-rules=MAP {HOST} 127.0.0.1",
    ]
    browser = playwright.chromium.launch(executable_path=chromium(), args=arguments)
    yield Lane("llvmpipe", browser)
    browser.close()


@pytest.fixture(scope="module")
def named(server: str) -> str:
    """Address of the server by a name."""
    return f"http://{HOST}:{urlsplit(server).port}"


def pasted(page: Page) -> str:
    """What the clipboard has, as a page in which somebody pastes it sees it."""
    page.evaluate("() => document.body.insertAdjacentHTML('beforeend', '<textarea id=pasted></textarea>')")
    page.locator("#pasted").focus()
    page.keyboard.press("Control+V")
    text: str = page.locator("#pasted").input_value()
    page.locator("#pasted").evaluate("(area) => area.remove()")
    return text


def test_take_home_copies(plain: Lane, named: str) -> None:
    with visit(plain, named, "#paused=1&quality=fast&preset=paper-halftone&open=take", settle=False) as made:
        page = made.page
        assert page.evaluate("() => [isSecureContext, navigator.clipboard === undefined]") == [False, True]
        page.get_by_role("button", name="Copy curl").click()
        expect(page.get_by_role("button", name="Copied")).to_be_visible()
        text = page.locator("pre[aria-label=curl]").inner_text()
        page.keyboard.press("Escape")
        assert pasted(page).strip() == text.strip()


def test_the_mask_laboratory_copies(plain: Lane, named: str) -> None:
    with visit(plain, named, "masks/", settle=False) as made:
        made.press("Copy code")
        expect(made.page.get_by_role("status").filter(has_text="Copied.")).to_be_visible()
        assert pasted(made.page).strip() == made.page.locator(".take-home pre").inner_text().strip()


def test_a_browser_that_copies_nothing_is_told(plain: Lane, named: str) -> None:
    with visit(plain, named, "masks/", settle=False) as made:
        made.page.evaluate("() => { document.execCommand = () => false; }")
        made.press("Copy code")
        expect(made.page.get_by_role("status").filter(has_text="Select the code to copy it.")).to_be_visible()


def test_the_notebooks_widget_draws(plain: Lane, named: str) -> None:
    page = plain.browser.new_context(viewport={"width": 960, "height": 600}, bypass_csp=True).new_page()
    cell = Cell(page, Water("paper-halftone", time=4.0, quality="fast", playing=False))
    cell.show_at(named)
    assert page.evaluate("() => crypto.randomUUID === undefined")
    assert cell.seen().std() > 5
    assert cell.complaints == []
    page.context.close()
