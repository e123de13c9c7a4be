"""The page below a path of a proxy: it, the API reference and the notebook's widget load nothing from elsewhere."""

from collections.abc import Iterator

import pytest
from playwright.sync_api import expect
from test_notebook_page import Cell

from seafoam.notebook import Water
from support.browser.lanes import Lane
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
