"""Firefox by WebDriver BiDi and WebKitGTK by WebDriver, as far as tests need them."""

import http.client
import json
import os
import re
import shutil
import subprocess
import tempfile
import time
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from typing import Any

from anyio.from_thread import start_blocking_portal
from tornado.websocket import websocket_connect

from support.command import free_port


class Engine:
    """A browser with one tab, whose driver has these members.

    ``complaints``: what went wrong on the page since it was visited. ``size``: give the page this size, css px.
    ``visit``: load a page, which is there when this returns. ``evaluate``: the value of an expression in the page,
    awaited. ``act``: perform actions as both WebDrivers describe them. ``close``: end the browser.
    """

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
        self.act([source])


PREFERENCES: dict[str, bool | int | str] = {
    "app.update.enabled": False,
    "browser.shell.checkDefaultBrowser": False,
    "browser.startup.homepage_override.mstone": "ignore",
    "datareporting.policy.dataSubmissionEnabled": False,
    "dom.w3c_touch_events.enabled": True,
    # A page that comes to another process, or from the cache of pages, may never be said to be there (bug 1746154).
    "fission.bfcacheInParent": False,
    "fission.webContentIsolationStrategy": 0,
    "webgl.force-enabled": True,
    # Software rendering counts as a performance caveat.
    "webgl.disable-fail-if-major-performance-caveat": True,
}
START = 60.0
"""Longest time for the browser to listen, s."""
ANSWER = 180.0
"""Longest time for it to answer a command, s."""


class Firefox(Engine):
    """A browser with one tab and a profile of its own."""

    def __init__(self, display: str) -> None:
        found = shutil.which("firefox-esr") or shutil.which("firefox")
        assert found, "no Firefox: apt-get install firefox-esr"
        self.profile = Path(tempfile.mkdtemp(prefix="firefox-"))
        lines = [f'user_pref("{name}", {json.dumps(value)});' for name, value in PREFERENCES.items()]
        (self.profile / "user.js").write_text("\n".join(lines))
        self.log = self.profile / "log"
        command = [found, "--remote-debugging-port", "0", "--profile", str(self.profile), "--no-remote"]
        environment = {**os.environ, "HOME": str(self.profile), "DISPLAY": display}
        with self.log.open("w") as log:
            self.process = subprocess.Popen(command, stdout=log, stderr=log, env=environment)
        self.said: list[str] = []
        self.count = 0
        # Playwright leaves an event loop in the tests' thread: this one runs in its own.
        self.loop = ExitStack()
        self.portal = self.loop.enter_context(start_blocking_portal())
        self.connection = self.awaited(websocket_connect, f"ws://127.0.0.1:{self.port()}/session")
        self.call("session.new", capabilities={})
        self.call("session.subscribe", events=["log.entryAdded"])
        self.tab: str = self.call("browsingContext.getTree")["contexts"][0]["context"]

    def port(self) -> int:
        deadline = time.monotonic() + START
        while time.monotonic() < deadline:
            listening = re.search(r"ws://127\.0\.0\.1:(\d+)", self.log.read_text())
            if listening:
                return int(listening[1])
            assert self.process.poll() is None, self.log.read_text()
            time.sleep(0.1)
        raise AssertionError(f"Firefox does not listen: {self.log.read_text()}")

    def awaited(self, call: Callable[..., Any], *given: Any) -> Any:
        """What a call returns that the loop awaits."""
        return self.portal.start_task_soon(call, *given).result(ANSWER)

    def call(self, method: str, **parameters: Any) -> Any:
        """Send a command and return its result; what the page says meanwhile is noted."""
        self.count += 1
        command = json.dumps({"id": self.count, "method": method, "params": parameters})
        self.awaited(self.connection.write_message, command)
        while True:
            message = json.loads(self.awaited(self.connection.read_message))
            if message["type"] == "event":
                entry = message["params"]
                if entry["level"] == "error":
                    self.said.append(entry["text"])
            elif message["id"] == self.count:
                assert message["type"] == "success", f"{method}: {message['error']}: {message['message']}"
                return message["result"]

    @property
    def complaints(self) -> list[str]:
        return self.said

    def size(self, width: int, height: int) -> None:
        viewport = {"width": width, "height": height}
        self.call("browsingContext.setViewport", context=self.tab, viewport=viewport, devicePixelRatio=1)

    def visit(self, address: str) -> None:
        # From another document: a change of the fragment alone would load nothing.
        self.call("browsingContext.navigate", context=self.tab, url="about:blank", wait="complete")
        self.said.clear()
        self.call("browsingContext.navigate", context=self.tab, url=address, wait="complete")

    def evaluate(self, expression: str) -> Any:
        """Return the value of an expression in the page, awaited."""
        wrapped = f"(async () => JSON.stringify((await ({expression})) ?? null))()"
        target = {"context": self.tab}
        reply = self.call("script.evaluate", expression=wrapped, target=target, awaitPromise=True)
        assert reply["type"] == "success", reply["exceptionDetails"]["text"]
        return json.loads(reply["result"]["value"])

    def act(self, actions: list[dict[str, Any]]) -> None:
        self.call("input.performActions", context=self.tab, actions=actions)

    def close(self) -> None:
        self.portal.call(self.connection.close)
        # It may have hung. Whoever still waits for its answer is told that it has gone.
        self.process.kill()
        self.process.wait(timeout=30)
        self.loop.close()
        shutil.rmtree(self.profile, ignore_errors=True)


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
