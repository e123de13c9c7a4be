"""The page behind a proxy, by a name and over plain HTTP: it, laboratories, the API reference, the notebook's widget.

Browsers trust this machine's own address as they trust HTTPS, and a name not.
"""

from collections.abc import Iterator
from urllib.parse import urlsplit

import pytest
from playwright.sync_api import Page, expect
from test_notebook_page import Cell

from seafoam.notebook import Water
from support.browser.lanes import HOST, Lane
from support.browser.proxy import proxied
from support.browser.visits import visit


@pytest.fixture(scope="module")
def behind(server: str) -> Iterator[str]:
    with proxied(server, "/water") as outside:
        yield f"http://{HOST}:{urlsplit(outside).port}/water"


def test_the_page_draws(llvmpipe: Lane, behind: str) -> None:
    with visit(llvmpipe, behind, "water/paper-halftone#paused=1&quality=fast&draw=browser") as made:
        made.follow("#paused=1&quality=fast&draw=server")
        made.settle()
        made.page.locator(".served canvas").wait_for()
        assert made.page.locator("html").get_attribute("lang") == "en"
        assert [url for _, url in made.asked if url.startswith("http") and not url.startswith(f"{behind}/")] == []


def test_the_reference_tries_operations(llvmpipe: Lane, behind: str) -> None:
    with visit(llvmpipe, behind, "docs", settle=False) as made:
        operation = made.page.locator(".opblock", has_text="/healthz")
        operation.locator(".opblock-summary-control").click()
        operation.get_by_role("button", name="Try it out").click()
        with made.page.expect_response(f"{behind}/healthz") as answer:
            operation.get_by_role("button", name="Execute").click()
        assert answer.value.status == 200
        expect(operation).to_contain_text("alive")


def test_the_notebooks_widget_draws(llvmpipe: Lane, behind: str) -> None:
    with llvmpipe.browser.new_context(viewport={"width": 960, "height": 600}) as context:
        page = context.new_page()
        asked: list[str] = []
        page.on("request", lambda request: asked.append(request.url))
        cell = Cell(page, Water("paper-halftone", time=4.0, quality="fast", playing=False))
        cell.show_at(behind)
        assert page.evaluate("() => crypto.randomUUID === undefined")
        assert cell.seen().std() > 5
        assert cell.complaints == []
        assert f"{behind}/notebook/seafoam-widget.js" in asked
        assert [url for url in asked if url.startswith("http") and not url.startswith(f"{behind}/")] == []


def pasted(page: Page) -> str:
    """What the clipboard has, as a page in which somebody pastes it sees it."""
    page.evaluate("() => document.body.insertAdjacentHTML('beforeend', '<textarea id=pasted></textarea>')")
    page.locator("#pasted").focus()
    page.keyboard.press("Control+V")
    text: str = page.locator("#pasted").input_value()
    page.locator("#pasted").evaluate("(area) => area.remove()")
    return text


def test_take_home_copies(llvmpipe: Lane, behind: str) -> None:
    with visit(llvmpipe, behind, "#paused=1&quality=fast&preset=paper-halftone&open=take", settle=False) as made:
        page = made.page
        assert page.evaluate("() => [isSecureContext, navigator.clipboard === undefined]") == [False, True]
        page.get_by_role("button", name="Copy curl").click()
        expect(page.get_by_role("button", name="Copied")).to_be_visible()
        text = page.locator("pre[aria-label=curl]").inner_text()
        page.keyboard.press("Escape")
        assert pasted(page).strip() == text.strip()


def test_the_mask_laboratory_copies_and_a_browser_that_copies_nothing_is_told(llvmpipe: Lane, behind: str) -> None:
    with visit(llvmpipe, behind, "masks/", settle=False) as made:
        status = made.page.get_by_role("status")
        made.press("Copy code")
        expect(status.filter(has_text="Copied.")).to_be_visible()
        assert pasted(made.page).strip() == made.page.locator(".take-home pre").inner_text().strip()
        made.page.evaluate("() => { document.execCommand = () => false; }")
        made.press("Copy code")
        expect(status.filter(has_text="Select the code to copy it.")).to_be_visible()
