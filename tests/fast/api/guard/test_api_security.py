"""Headers that tell a browser what a page may load and do, and pages that need no more."""

import re
from html.parser import HTMLParser

import pytest
from starlette.testclient import TestClient

PAGES = ("/", "/docs")


class Inline(HTMLParser):
    """Collects what a policy without ``unsafe-inline`` would block."""

    def __init__(self) -> None:
        super().__init__()
        self.found: list[str] = []
        self.scripts = 0

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        names = dict(attrs)
        self.scripts += tag == "script"
        if (tag == "script" and "src" not in names) or tag == "style":
            self.found.append(tag)
        self.found += [name for name in names if name == "style" or name.startswith("on")]


@pytest.mark.parametrize("url", PAGES)
def test_a_page_runs_and_loads_nothing_but_files_of_the_server(client: TestClient, url: str) -> None:
    response = client.get(url)
    policy = dict(rule.split(" ", 1) for rule in response.headers["Content-Security-Policy"].split("; "))
    assert policy["default-src"] == "'none'"
    for kind in ("script-src", "style-src", "connect-src", "font-src", "worker-src", "base-uri"):
        assert policy[kind] == "'self'", kind
    assert policy["img-src"].split() == ["'self'", "blob:", "data:"]
    assert policy["frame-ancestors"] == "'self'"
    assert not re.search(r"unsafe|https?:|\*", response.headers["Content-Security-Policy"])
    page = Inline()
    page.feed(response.text)
    assert page.scripts >= 2
    assert page.found == []
    others = {
        "X-Content-Type-Options": "nosniff",
        "X-Frame-Options": "SAMEORIGIN",
        "Referrer-Policy": "strict-origin-when-cross-origin",
        "Permissions-Policy": "camera=(), geolocation=(), microphone=()",
    }
    assert {name: response.headers.get(name) for name in others} == others


def test_an_opener_policy_is_sent_only_where_browsers_heed_it_and_pages_alone_have_a_content_policy(
    client: TestClient,
) -> None:
    assert "Cross-Origin-Opener-Policy" not in client.get("http://testserver/").headers
    assert client.get("https://testserver/").headers["Cross-Origin-Opener-Policy"] == "same-origin"
    for url in ("/api/presets", "/api/presets/none", "/icon.svg"):
        headers = client.get(url).headers
        assert headers["X-Content-Type-Options"] == "nosniff"
        assert "Content-Security-Policy" not in headers
