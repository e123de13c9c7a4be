"""Firefox by WebDriver BiDi: commands and events over one web socket, as far as the tests need them."""

import base64
import json
import os
import re
import secrets
import shutil
import socket
import struct
import subprocess
import tempfile
import time
from pathlib import Path
from typing import Any

from support.browser.engine import Engine

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


class WebSocket:
    """A client of one connection: text messages, masked as the protocol demands (RFC 6455)."""

    def __init__(self, port: int, path: str) -> None:
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=ANSWER)
        key = base64.b64encode(secrets.token_bytes(16)).decode()
        lines = (
            f"GET {path} HTTP/1.1",
            f"Host: 127.0.0.1:{port}",
            "Upgrade: websocket",
            "Connection: Upgrade",
            f"Sec-WebSocket-Key: {key}",
            "Sec-WebSocket-Version: 13",
        )
        self.socket.sendall("\r\n".join([*lines, "", ""]).encode())
        self.stream = self.socket.makefile("rb")
        status = self.stream.readline()
        assert b" 101 " in status, status
        while self.stream.readline().strip():
            pass

    def send(self, text: str) -> None:
        data, key = text.encode(), secrets.token_bytes(4)
        size = len(data)
        if size < 126:
            head = struct.pack(">BB", 0x81, 0x80 | size)
        elif size < 1 << 16:
            head = struct.pack(">BBH", 0x81, 0x80 | 126, size)
        else:
            head = struct.pack(">BBQ", 0x81, 0x80 | 127, size)
        mask = (key * (size // 4 + 1))[:size]
        masked = int.from_bytes(data) ^ int.from_bytes(mask)
        self.socket.sendall(head + key + masked.to_bytes(size))

    def close(self) -> None:
        self.stream.close()
        self.socket.close()

    def receive(self) -> str:
        message = b""
        while True:
            first, second = self.stream.read(2)
            size = second & 0x7F
            if size >= 126:
                form = ">H" if size == 126 else ">Q"
                (size,) = struct.unpack(form, self.stream.read(struct.calcsize(form)))
            message += self.stream.read(size)
            if first & 0x80:
                return message.decode()


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
        self.connection = WebSocket(self.port(), "/session")
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

    def call(self, method: str, **parameters: Any) -> Any:
        """Send a command and return its result; what the page says meanwhile is noted."""
        self.count += 1
        self.connection.send(json.dumps({"id": self.count, "method": method, "params": parameters}))
        while True:
            try:
                message = json.loads(self.connection.receive())
            except TimeoutError:
                self.hung = True
                raise AssertionError(f"no answer to {method} in {ANSWER:.0f} s") from None
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
        self.connection.close()
        if self.hung:
            self.process.kill()
        else:
            self.process.terminate()
        self.process.wait(timeout=30)
        shutil.rmtree(self.profile, ignore_errors=True)
