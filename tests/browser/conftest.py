"""A served page in a real Chromium, on two renderers: the server's own llvmpipe, and SwiftShader."""

import urllib.request
from collections.abc import Iterator
from urllib.parse import urlsplit

import pytest
from playwright.sync_api import Page, Playwright, expect, sync_playwright

from support.browser.lanes import HOST, Lane, launched, opened
from support.browser.proxy import proxied
from support.browser.visits import PHONE, UNMOVED, Visit, visit
from support.command import served

# Beside other tests, what a page shows takes longer than the 5 s that Playwright would wait.
expect.set_options(timeout=30_000)


@pytest.fixture(scope="session")
def server() -> Iterator[str]:
    """Address of a running server.

    Frames wait for other tests' frames and programs here. A browser that is closed keeps its streams until their lease
    ends: the next test's page needs others.
    """
    # In this form the log says nothing of requests on the pipe that nobody reads.
    with served(SEAFOAM_DEADLINE="60", SEAFOAM_STREAMS="8", SEAFOAM_LOG_FORMAT="json") as address:
        # Answered once a worker draws.
        urllib.request.urlopen(f"{address}/api/frames/paper-threshold.png?width=16&height=16", timeout=60).close()
        yield address


@pytest.fixture(scope="session")
def behind(server: str) -> Iterator[str]:
    """Address of the server behind a proxy, by a name and over plain HTTP.

    Browsers trust this machine's own address as they trust HTTPS, and a name not.
    """
    with proxied(server, "/water") as outside:
        yield f"http://{HOST}:{urlsplit(outside).port}/water"


@pytest.fixture(scope="session")
def playwright() -> Iterator[Playwright]:
    with sync_playwright() as started:
        yield started


@pytest.fixture(scope="session")
def llvmpipe(playwright: Playwright) -> Iterator[Lane]:
    browser = launched(playwright, "llvmpipe")
    yield Lane("llvmpipe", browser)
    browser.close()


@pytest.fixture(scope="module")
def page(llvmpipe: Lane, server: str) -> Iterator[Page]:
    """The page on the server's own renderer."""
    made = opened(llvmpipe, server)
    yield made
    made.close()


@pytest.fixture(scope="module")
def other(playwright: Playwright, server: str) -> Iterator[Page]:
    """The page on another renderer."""
    with launched(playwright, "SwiftShader") as browser:
        yield opened(Lane("SwiftShader", browser), server)


@pytest.fixture(scope="session")
def shared(llvmpipe: Lane, server: str) -> Iterator[Visit]:
    with visit(llvmpipe, server) as made:
        yield made


@pytest.fixture(scope="session")
def shared_phone(llvmpipe: Lane, server: str) -> Iterator[Visit]:
    context = {"has_touch": True, "is_mobile": True, "reduced_motion": "reduce"}
    with visit(llvmpipe, server, UNMOVED, size=PHONE, **context) as made:
        yield made


@pytest.fixture
def small(shared: Visit) -> Iterator[Visit]:
    """The page, small, as it was when it opened; nothing may have gone wrong on it by the end."""
    with shared.awake():
        shared.start_again()
        yield shared
    assert shared.complaints == []
