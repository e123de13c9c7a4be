"""A served page in a real Chromium, on two renderers: the server's own llvmpipe, and SwiftShader."""

import os
import subprocess
import sys
import time
import urllib.error
import urllib.request
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Page, Playwright, expect, sync_playwright

from support.browser.lanes import Lane, launched, opened
from support.browser.visits import Visit, visit
from support.command import free_port

# Beside other tests, what a page shows takes longer than the 5 s that Playwright would wait.
expect.set_options(timeout=30_000)


@pytest.fixture(scope="session")
def server() -> Iterator[str]:
    """Address of a running server."""
    port = free_port()
    # Frames wait for other tests' frames and programs here.
    command = [Path(sys.executable).with_name("seafoam"), "serve", "--port", str(port)]
    # A browser that is closed keeps its streams until their lease ends: the next test's page needs others.
    process = subprocess.Popen(command, env={**os.environ, "SEAFOAM_DEADLINE": "60", "SEAFOAM_STREAMS": "8"})
    address = f"http://127.0.0.1:{port}"
    try:
        for _ in range(300):
            assert process.poll() is None, "the server stopped"
            try:
                if urllib.request.urlopen(f"{address}/readyz", timeout=5).status == 200:
                    break
            except (urllib.error.URLError, ConnectionError):
                time.sleep(0.2)
        else:
            raise AssertionError("the server did not become ready within a minute")
        yield address
    finally:
        process.terminate()
        process.wait(timeout=20)


@pytest.fixture(scope="session")
def playwright() -> Iterator[Playwright]:
    with sync_playwright() as started:
        yield started


@pytest.fixture(scope="session")
def llvmpipe(playwright: Playwright) -> Iterator[Lane]:
    browser = launched(playwright, "llvmpipe")
    yield Lane("llvmpipe", browser)
    browser.close()


@pytest.fixture(scope="session")
def optimised(playwright: Playwright) -> Iterator[Lane]:
    """As users have it, for pages that draw many frames: the ``llvmpipe`` of the folder ``motion``."""
    browser = launched(playwright, "llvmpipe", optimised=True)
    yield Lane("llvmpipe", browser)
    browser.close()


@pytest.fixture(scope="session")
def swiftshader(playwright: Playwright) -> Iterator[Lane]:
    browser = launched(playwright, "SwiftShader")
    yield Lane("SwiftShader", browser)
    browser.close()


@pytest.fixture(scope="module")
def page(llvmpipe: Lane, server: str) -> Iterator[Page]:
    """The page on the server's own renderer."""
    made = opened(llvmpipe, server)
    yield made
    made.close()


@pytest.fixture(scope="package")
def other(swiftshader: Lane, server: str) -> Iterator[Page]:
    """The page on another renderer."""
    made = opened(swiftshader, server)
    yield made
    made.close()


@pytest.fixture(scope="module")
def shared(llvmpipe: Lane, server: str) -> Iterator[Visit]:
    with visit(llvmpipe, server) as made:
        yield made


@pytest.fixture
def small(shared: Visit) -> Iterator[Visit]:
    """The page, small, as it was when it opened; nothing may have gone wrong on it by the end."""
    shared.start_again()
    yield shared
    assert shared.complaints == []
