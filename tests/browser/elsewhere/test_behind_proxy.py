"""The page behind a proxy and over plain HTTP: it, the API reference and the notebook's widget."""

from collections.abc import Iterator
from urllib.parse import urlsplit

import pytest
from playwright.sync_api import Page, Playwright, expect
from test_notebook_page import Cell

from seafoam.notebook import Water
from support.browser.lanes import COMMON, LANES, Lane, chromium
from support.browser.proxy import proxied
from support.browser.visits import visit


@pytest.fixture(scope="module")
def behind(server: str) -> Iterator[str]:
    with proxied(server, "/water") as outside:
        yield outside


@pytest.mark.parametrize("draw", ["browser", "server"])
def test_the_page_draws(llvmpipe: Lane, behind: str, draw: str) -> None:
    with visit(llvmpipe, behind, f"water/paper-halftone#paused=1&quality=fast&draw={draw}") as made:
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
    with llvmpipe.browser.new_context(bypass_csp=True) as context:
        page = context.new_page()
        asked: list[str] = []
        page.on("request", lambda request: asked.append(request.url))
        cell = Cell(page, Water("paper-halftone", time=4.0, quality="fast", playing=False))
        cell.show_at(behind)
        assert cell.seen().std() > 5
        assert cell.complaints == []
        assert f"{behind}/notebook/seafoam-widget.js" in asked
        assert [url for url in asked if url.startswith("http") and not url.startswith(f"{behind}/")] == []


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


def test_the_notebooks_widget_draws_over_plain_http(plain: Lane, named: str) -> None:
    page = plain.browser.new_context(viewport={"width": 960, "height": 600}, bypass_csp=True).new_page()
    cell = Cell(page, Water("paper-halftone", time=4.0, quality="fast", playing=False))
    cell.show_at(named)
    assert page.evaluate("() => crypto.randomUUID === undefined")
    assert cell.seen().std() > 5
    assert cell.complaints == []
    page.context.close()
