"""The API in this process, with renderers that only pretend to draw or with GL, and what tests ask of it."""

import asyncio
import io
import os
import subprocess
import sys
import time
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from urllib.parse import urlencode

from fastapi import FastAPI
from PIL import Image
from starlette.testclient import TestClient

from seafoam.api.app import create_app
from seafoam.api.context import ThreadPool
from seafoam.api.frames.plans import RequestCache
from seafoam.api.frames.streams import Streams
from seafoam.api.settings import Settings
from support.api_fakes import FakeRenderer
from support.command import FAKED, free_port

SMALL = {"width": 24, "height": 16}
LOG = "server.log"


@cache
def document() -> dict[str, Any]:
    """What an app says of itself, which takes a second to make; none of it depends on settings."""
    return create_app(Settings(), renderer=FakeRenderer).openapi()


def made(renderer, **settings) -> FastAPI:
    app = create_app(Settings(**settings), renderer=renderer)
    app.openapi = document
    return app


@contextmanager
def serving(renderer=FakeRenderer, **settings) -> Iterator[TestClient]:
    """A running app, ready or found unable. Workers start slowly beside other tests, so the deadline is long."""
    app = made(renderer, **{"workers": 1, "deadline": 60.0, **settings})
    with TestClient(app, raise_server_exceptions=False) as client:
        yield client


def frame(client, suffix="png", preset="default", **params):
    response = client.get(f"/api/frames/{preset}.{suffix}", params=SMALL | params)
    assert response.status_code == 200, response.text
    return response


def picture(response):
    return Image.open(io.BytesIO(response.content))


def problem(response, status):
    """The body of an error."""
    assert response.status_code == status, response.text
    assert response.headers["Content-Type"] == "application/problem+json"
    assert response.headers["Cache-Control"] == "no-store"
    body = response.json()
    assert body["status"] == status
    assert {"type", "title", "detail", "instance"} <= set(body)
    return body


class Clock:
    """Seconds that pass when told."""

    def __init__(self, now: float = 1000.0) -> None:
        self.now = now

    def __call__(self) -> float:
        return self.now


async def eventually(condition, seconds=30.0):
    """Wait until a condition holds."""
    async with asyncio.timeout(seconds):
        while not condition():
            await asyncio.sleep(0.01)


@contextmanager
def busy(client: TestClient):
    """While the only worker of a server is taken: its pool."""
    pool = client.app.state.context.pool
    client.portal.call(pool._free_workers.acquire)
    try:
        yield pool
    finally:
        client.portal.call(pool._free_workers.release)


def left_status(client: TestClient, path: str, **params) -> int:
    """What a client is answered that leaves while its frame waits for the only worker."""
    query = urlencode(params).encode()
    scope = {
        "type": "http", "method": "GET", "path": path, "raw_path": path.encode(), "query_string": query, "headers": [],
        "http_version": "1.1", "scheme": "http", "root_path": "",
    }  # fmt: skip
    pool, sent = client.app.state.context.pool, []

    async def leave():
        arriving = iter([{"type": "http.request", "body": b"", "more_body": False}])

        async def receive():
            for message in arriving:
                return message
            await eventually(lambda: len(pool._tickets) == 1)
            return {"type": "http.disconnect"}

        async def send(message):
            sent.append(message)

        await pool._free_workers.acquire()
        await client.app(scope, receive, send)
        pool._free_workers.release()

    client.portal.call(leave)
    return sent[0]["status"]


def answering(**settings) -> TestClient:
    """The app without a render pool, for what does not depend on frames: it starts nothing, and costs nothing."""
    app = made(FakeRenderer, **settings)
    app.state.context = SimpleNamespace(
        settings=Settings(**settings),
        request_cache=RequestCache(16),
        pool=SimpleNamespace(info={}, state="starting"),
        masks=ThreadPool(1, 8),
        streams=Streams(2),
    )
    return TestClient(app, raise_server_exceptions=False)


@contextmanager
def served(folder: Path, **environment: str) -> Iterator[tuple[str, "subprocess.Popen[bytes]"]]:
    """`seafoam serve` with a renderer that only pretends to draw: its address and its process, once it is ready.

    What it says is in ``LOG`` of the folder.
    """
    address = f"http://127.0.0.1:{(port := free_port())}"
    variables = {**os.environ, "SEAFOAM_WORKERS": "1", **environment}
    command = [sys.executable, "-c", FAKED, "serve", "--port", str(port)]
    with (folder / LOG).open("w") as log:
        process = subprocess.Popen(command, env=variables, stdout=log, stderr=subprocess.STDOUT)
    try:
        for _ in range(600):
            assert process.poll() is None
            try:
                urllib.request.urlopen(f"{address}/readyz", timeout=60).close()
                break
            except OSError:
                time.sleep(0.1)
        yield address, process
    finally:
        process.kill()
        process.wait()
