"""The page and the API reference under their security policy, which other tests set aside."""

from typing import Any

from playwright.sync_api import Page

from support.browser.lanes import Lane
from support.browser.visits import link, until, visit

REPORTS = """
window.blocked = [];
document.addEventListener("securitypolicyviolation", ({ violatedDirective, blockedURI, sample }) =>
  window.blocked.push([violatedDirective, blockedURI, sample].join(" ")));
"""


def blocked(page: Page) -> list[Any]:
    """What the policy has blocked since the page opened."""
    return page.evaluate("() => window.blocked")


def test_the_policy_is_in_force(llvmpipe: Lane, server: str) -> None:
    with visit(llvmpipe, server, "docs", settle=False, bypass_csp=False) as made:
        made.expected = "Content Security Policy"
        made.page.evaluate(REPORTS)
        made.page.evaluate("() => document.body.setAttribute('style', 'color: red')")
        until(made.page, "() => window.blocked.length > 0")
        assert "style-src-attr" in blocked(made.page)[0]


def test_the_page_needs_nothing_that_its_policy_forbids(llvmpipe: Lane, server: str) -> None:
    with visit(llvmpipe, server, link(), settle=False, bypass_csp=False, size=(760, 700)) as made:
        page = made.page
        page.add_init_script(REPORTS)
        page.reload(wait_until="load")
        until(page, "() => window.seafoam?.state().settled === true")
        page.get_by_role("button", name="Settings", exact=True).click()
        light = page.locator("#settings").get_by_role("button", name="light", exact=True)
        light.click()
        # Tweakpane's own styles are in force.
        folder = page.locator("#settings .tp-fldv").first
        assert folder.evaluate("(folder) => getComputedStyle(folder).position") == "relative"
        page.get_by_role("button", name="Compare side by side").click()
        with page.expect_download() as download:
            page.get_by_role("button", name="Save image as PNG").click()
        assert download.value.suggested_filename.endswith(".png")
        page.get_by_role("button", name="Accuracy benchmark").click()
        page.locator("#accuracy.open").wait_for()
        assert blocked(page) == []


def test_the_api_reference_needs_nothing_that_its_policy_forbids(llvmpipe: Lane, server: str) -> None:
    with visit(llvmpipe, server, "docs", settle=False, bypass_csp=False) as made:
        page = made.page
        page.add_init_script(REPORTS)
        page.reload(wait_until="load")
        operation = page.locator(".opblock", has=page.locator("[data-path='/api/presets']"))
        operation.wait_for()
        operation.click()
        page.get_by_role("button", name="Try it out").click()
        page.get_by_role("button", name="Execute").click()
        page.locator(".live-responses-table .response-col_status", has_text="200").wait_for()
        assert blocked(page) == []
        assert made.complaints == []
        assert [url for _, url in made.asked if not url.startswith((server, "data:"))] == []
