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

from support.command import free_port

BROWSERS = "usr/lib/*/webkit2gtk-4.*/MiniBrowser"
LISTENING = """(() => {
  window.complaints ??= (() => {
    const said = [];
    for (const type of ['error', 'unhandledrejection', 'securitypolicyviolation'])
      addEventListener(type, (event) => said.push([type, event.message ?? event.reason ?? event.violatedDirective].join()), true);
    console.error = console.warn = (...parts) => said.push(parts.join(' '));
    return said;
  })();
  return true;
})()"""
"""Has the page keep what it complains of, for the driver tells nothing of it."""
START = 60.0
"""Longest time for the driver to listen, s."""


class WebKit:
    """A MiniBrowser with one tab, without its bars, which would make it wider than a phone, and without a profile."""

    def __init__(self, display: str) -> None:
        driver = shutil.which("WebKitWebDriver")
        browsers = sorted(Path("/").glob(BROWSERS))
        assert driver and browsers, "no WebKitGTK: apt-get install webkit2gtk-driver"
        self.home = tempfile.mkdtemp(prefix="webkit-")
        self.port = free_port()
        environment = {**os.environ, "HOME": self.home, "DISPLAY": display, "GDK_BACKEND": "x11"}
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
        self.evaluate("window.open('about:blank', 'bare', 'width=400,height=400,toolbar=no,location=no,menubar=no') !== null")
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
                assert self.process.poll() is None and time.monotonic() < deadline, "the driver does not listen"
                time.sleep(0.1)
                continue
            finally:
                connection.close()
            assert reply.status == 200, f"{path}: {value}"
            return value

    @property
    def complaints(self) -> list[str]:
        """What went wrong on the page since its first script ran."""
        said: list[str] = self.evaluate("window.complaints")
        return said

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
        self.call("POST", "/url", {"url": "about:blank"})
        self.until("location.href === 'about:blank'")
        self.call("POST", "/url", {"url": address})
        # While its scripts are still on their way. A promise would be lost with the page before.
        script = f"return location.href !== 'about:blank' && {LISTENING}"
        while not self.call("POST", "/execute/sync", {"script": script, "args": []}):
            pass
        self.until("document.readyState === 'complete'")

    def evaluate(self, expression: str) -> Any:
        """Return the value of an expression in the page, awaited."""
        script = (
            f"const done = arguments[0]; (async () => JSON.stringify((await ({expression})) ?? null))()"
            ".then((text) => done([text, null]), (error) => done([null, String(error)]));"
        )
        text, error = self.call("POST", "/execute/async", {"script": script, "args": []})
        assert error is None, error
        return json.loads(text)

    def until(self, condition: str, seconds: float = 120) -> None:
        deadline = time.monotonic() + seconds
        while time.monotonic() < deadline:
            if self.evaluate(condition):
                return
            time.sleep(0.1)
        raise AssertionError(f"never true: {condition}; {self.complaints}")

    def press(self, kind: str, *places: tuple[int, int]) -> None:
        """Put a pointer (``mouse`` or ``touch``) down at the first place, move it along the others and lift it."""
        (x, y), *rest = places
        actions: list[dict[str, Any]] = [{"type": "pointerMove", "x": x, "y": y}, {"type": "pointerDown", "button": 0}]
        actions += [{"type": "pointerMove", "x": x, "y": y, "duration": 50} for x, y in rest]
        actions += [{"type": "pause", "duration": 150}, {"type": "pointerUp", "button": 0}]
        source = {"type": "pointer", "id": kind, "parameters": {"pointerType": kind}, "actions": actions}
        self.call("POST", "/actions", {"actions": [source]})

    def close(self) -> None:
        self.call("DELETE", "")
        self.process.terminate()
        self.process.wait(timeout=30)
        shutil.rmtree(self.home, ignore_errors=True)
