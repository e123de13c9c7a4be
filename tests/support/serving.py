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
from pathlib import Path
from types import SimpleNamespace

from PIL import Image
from starlette.testclient import TestClient

from seafoam.api.app import create_app
from seafoam.api.frames.request_cache import RequestCache
from seafoam.api.frames.streams import Streams
from seafoam.api.http.thread_pool import ThreadPool
from seafoam.api.settings import Settings
from support.api_fakes import FakeRenderer
from support.command import free_port

SMALL = {"width": 24, "height": 16}
SERVER = """
from functools import partial
from seafoam.api import app
from seafoam.api.routers import presets
from support.api_fakes import FakeRenderer

async def plan_none(plans):
    pass

app.create_app = partial(app.create_app, renderer=FakeRenderer)
# Seconds of every start: whoever asks for the list of presets has it made then.
presets.warm = plan_none
if __name__ == "__main__":
    from seafoam.cli import main
    main()
"""


@contextmanager
def serving(renderer=FakeRenderer, **settings) -> Iterator[TestClient]:
    """A running app, ready or found unable. Workers start slowly beside other tests, so the deadline is long."""
    app = create_app(Settings(**{"workers": 1, "deadline": 60.0, **settings}), renderer=renderer)
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


async def eventually(condition, seconds=30.0):
    """Wait until a condition holds."""
    async with asyncio.timeout(seconds):
        while not condition():
            await asyncio.sleep(0.01)


def answering(**settings) -> TestClient:
    """The app without a render pool, for what does not depend on frames: it starts nothing, and costs nothing."""
    app = create_app(Settings(**settings), renderer=FakeRenderer)
    app.state.context = SimpleNamespace(
        settings=Settings(**settings),
        request_cache=RequestCache(),
        pool=SimpleNamespace(info={}, state="starting"),
        masks=ThreadPool(1, 8),
        streams=Streams(2),
    )
    return TestClient(app, raise_server_exceptions=False)


@contextmanager
def served(folder: Path, **environment: str) -> Iterator[tuple[str, "subprocess.Popen[str]"]]:
    """`seafoam serve` with a renderer that only pretends to draw: its address and its process, once it is ready."""
    script = folder / "served.py"
    script.write_text(SERVER)
    address = f"http://127.0.0.1:{(port := free_port())}"
    process = subprocess.Popen(
        [sys.executable, script, "serve", "--port", str(port)],
        env={**os.environ, "PYTHONPATH": str(Path(__file__).parents[1]), "SEAFOAM_WORKERS": "1", **environment},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
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
        process.communicate()
