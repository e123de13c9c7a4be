"""The page behind a proxy, by a name and over plain HTTP, and under its security policy: it, and the API reference."""

from typing import Any

from playwright.sync_api import Page, expect

from support.browser.accuracy_answers import awaited
from support.browser.lanes import Lane
from support.browser.visits import BLANK, link, until, visit

REPORTS = """
window.blocked = [];
document.addEventListener("securitypolicyviolation", ({ violatedDirective, blockedURI, sample }) =>
  window.blocked.push([violatedDirective, blockedURI, sample].join(" ")));
"""


def blocked(page: Page) -> list[Any]:
    """What the policy has blocked since the page opened."""
    return page.evaluate("() => window.blocked")


def pasted(page: Page) -> str:
    """What the clipboard has, as a page in which somebody pastes it sees it."""
    page.evaluate("() => document.body.insertAdjacentHTML('beforeend', '<textarea id=pasted></textarea>')")
    page.locator("#pasted").focus()
    page.keyboard.press("Control+V")
    text: str = page.locator("#pasted").input_value()
    page.locator("#pasted").evaluate("(area) => area.remove()")
    return text


def go(page: Page, fragment: str) -> None:
    page.evaluate("(fragment) => { location.hash = fragment; }", fragment)


def test_the_page_needs_nothing_that_its_policy_forbids_and_nothing_from_elsewhere(llvmpipe: Lane, behind: str) -> None:
    with visit(llvmpipe, behind, BLANK, settle=False, bypass_csp=False, size=(760, 700)) as made:
        page = made.page
        page.add_init_script(REPORTS)
        awaited(page)
        page.goto(f"{behind}/water/paper-halftone#paused=1&quality=fast&draw=browser", wait_until="load")
        until(page, "() => window.seafoam?.state().settled === true")
        assert page.locator("html").get_attribute("lang") == "en"
        made.press("Settings", exact=True)
        page.locator("#settings").get_by_role("button", name="light", exact=True).click()
        # Tweakpane's own styles are in force.
        folder = page.locator("#settings .tp-fldv").first
        assert folder.evaluate("(folder) => getComputedStyle(folder).position") == "relative"
        made.press("Close settings")
        made.press("Compare side by side")
        with page.expect_download() as download:
            made.press("Save image as PNG")
        assert download.value.suggested_filename.endswith(".png")
        made.press("Accuracy benchmark")
        page.locator("#accuracy.open").wait_for()
        page.keyboard.press("Escape")
        go(page, link(draw="server"))
        page.locator(".served canvas").wait_for()
        go(page, link(open="take"))
        assert page.evaluate("() => [isSecureContext, navigator.clipboard === undefined]") == [False, True]
        made.press("Copy curl")
        expect(page.get_by_role("button", name="Copied")).to_be_visible()
        text = page.locator("pre[aria-label=curl]").inner_text()
        page.keyboard.press("Escape")
        assert pasted(page).strip() == text.strip()
        assert blocked(page) == []
        assert [url for _, url in made.asked if url.startswith("http") and not url.startswith(f"{behind}/")] == []


def test_the_policy_is_in_force_and_the_api_reference_tries_operations_under_it(llvmpipe: Lane, behind: str) -> None:
    with visit(llvmpipe, behind, BLANK, settle=False, bypass_csp=False) as made:
        page = made.page
        page.add_init_script(REPORTS)
        page.goto(f"{behind}/docs", wait_until="load")
        operation = page.locator(".opblock", has_text="/healthz")
        operation.locator(".opblock-summary-control").click()
        operation.get_by_role("button", name="Try it out").click()
        with page.expect_response(f"{behind}/healthz") as answer:
            operation.get_by_role("button", name="Execute").click()
        assert answer.value.status == 200
        expect(operation).to_contain_text("alive")
        assert blocked(page) == []
        assert made.complaints == []
        assert [url for _, url in made.asked if not url.startswith((behind, "data:"))] == []
        made.expected = "Content Security Policy"
        page.evaluate("() => document.body.setAttribute('style', 'color: red')")
        until(page, "() => window.blocked.length > 0")
        assert "style-src-attr" in blocked(page)[0]
