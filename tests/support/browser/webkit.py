"""WebKitGTK by WebDriver (W3C, classic: Debian's driver speaks no BiDi), as far as the tests need it."""

import http.client
import json
import os
import shutil
import subprocess
import tempfile
import time
from pathlib import Path
from typing import Any

from support.browser.engine import Engine
from support.command import free_port

BROWSERS = "usr/lib/*/webkit2gtk-4.*/MiniBrowser"
ELSEWHERE = """location.href !== 'about:blank' && (() => {
  window.complaints ??= (() => {
    const said = [];
    const told = (event) =>
      said.push([event.type, event.message ?? event.reason ?? event.violatedDirective].join());
    for (const type of ['error', 'unhandledrejection', 'securitypolicyviolation']) addEventListener(type, told, true);
    console.error = console.warn = (...parts) => said.push(parts.join(' '));
    return said;
  })();
  return true;
})()"""
"""Also has the page keep what it complains of, since the driver tells nothing of it; its scripts are on their way."""
START = 60.0
"""Longest time for the driver to listen, s."""


class DriverError(AssertionError):
    """The driver refuses a command."""

    def __init__(self, code: str, message: str) -> None:
        super().__init__(f"{code}: {message}")
        self.code = code


class WebKit(Engine):
    """A MiniBrowser with one tab, without its bars, which would make it wider than a phone, and without a profile."""

    def __init__(self, display: str) -> None:
        driver = shutil.which("WebKitWebDriver")
        browsers = sorted(Path("/").glob(BROWSERS))
        assert driver is not None, "no WebKitGTK: apt-get install webkit2gtk-driver"
        assert browsers, "WebKitGTK has no MiniBrowser"
        self.home = tempfile.mkdtemp(prefix="webkit-")
        self.port = free_port()
        # Its language is the locale's, and "C" is none.
        language = {"LANG": "en_US.UTF-8", "LANGUAGE": "en_US"}
        environment = {**os.environ, **language, "HOME": self.home, "DISPLAY": display, "GDK_BACKEND": "x11"}
        self.process = subprocess.Popen(
            [driver, f"--port={self.port}"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=environment
        )
        self.session = ""
        arguments = ["--automation", "--javascript-can-open-windows-automatically=true"]
        options = {"binary": str(browsers[-1]), "args": arguments}
        asked = {"pageLoadStrategy": "none", "webkitgtk:browserOptions": options}
        session = self.call("POST", "/session", {"capabilities": {"alwaysMatch": asked}})
        self.session = f"/session/{session['sessionId']}"
        first = self.call("GET", "/window")
        self.evaluate(
            "window.open('about:blank', 'bare', 'width=400,height=400,toolbar=no,location=no,menubar=no') !== null"
        )
        (bare,) = set(self.call("GET", "/window/handles")) - {first}
        self.call("POST", "/window", {"handle": bare})

    def call(self, method: str, path: str, body: dict[str, Any] | None = None) -> Any:
        """Send a command and return its value."""
        deadline = time.monotonic() + START
        while True:
            connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=300)
            try:
                content = None if body is None else json.dumps(body)
                connection.request(method, self.session + path, content, {"Content-Type": "application/json"})
                reply = connection.getresponse()
                value = json.loads(reply.read())["value"]
            except ConnectionRefusedError:
                if self.process.poll() is not None or time.monotonic() > deadline:
                    raise
                time.sleep(0.1)
                continue
            finally:
                connection.close()
            if reply.status != 200:
                raise DriverError(value["error"], f"{path}: {value['message']}")
            return value

    @property
    def complaints(self) -> list[str]:
        """What went wrong on the page since its first script ran."""
        return self.evaluate("window.complaints")

    def size(self, width: int, height: int) -> None:
        """Give the page this size, css px."""
        for _ in range(3):
            inner = self.evaluate("[innerWidth, innerHeight]")
            if inner == [width, height]:
                return
            rect = self.call("GET", "/window/rect")
            wider = {"width": rect["width"] + width - inner[0], "height": rect["height"] + height - inner[1]}
            self.call("POST", "/window/rect", wider)
            time.sleep(0.3)
        raise AssertionError(f"the page is {self.evaluate('[innerWidth, innerHeight]')}")

    def visit(self, address: str) -> None:
        # From another document: a change of the fragment alone would load nothing.
        for url, there in (("about:blank", "location.href === 'about:blank'"), (address, ELSEWHERE)):
            self.call("POST", "/url", {"url": url})
            self.arrive(there)
        self.until("document.readyState === 'complete'")

    def arrive(self, there: str) -> None:
        """Wait until a page for which an expression is true has taken the place of another."""
        deadline = time.monotonic() + START
        while time.monotonic() < deadline:
            try:
                if self.call("POST", "/execute/sync", {"script": f"return {there}", "args": []}):
                    return
            except DriverError as error:
                # The page before has just gone.
                if error.code != "no such frame":
                    raise
        raise AssertionError(f"never true: {there}")

    def evaluate(self, expression: str) -> Any:
        """Return the value of an expression in the page, awaited."""
        script = (
            f"const done = arguments[0]; (async () => JSON.stringify((await ({expression})) ?? null))()"
            ".then((text) => done([text, null]), (error) => done([null, String(error)]));"
        )
        text, error = self.call("POST", "/execute/async", {"script": script, "args": []})
        assert error is None, error
        return json.loads(text)

    def act(self, actions: list[dict[str, Any]]) -> None:
        self.call("POST", "/actions", {"actions": actions})

    def close(self) -> None:
        self.call("DELETE", "")
        self.process.terminate()
        self.process.wait(timeout=30)
        shutil.rmtree(self.home, ignore_errors=True)
