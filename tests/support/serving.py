"""The API in this process, with renderers that only pretend to draw or with GL, and what tests ask of it."""

import io
from collections.abc import Iterator
from contextlib import contextmanager
from types import SimpleNamespace

from PIL import Image
from starlette.testclient import TestClient

from seafoam.api.app import create_app
from seafoam.api.known import Requests
from seafoam.api.settings import Settings
from seafoam.api.streams import Streams
from seafoam.api.threads import ThreadPool
from support.api_fakes import FakeRenderer

SMALL = {"width": 24, "height": 16}


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


def answering(**settings) -> TestClient:
    """The app without a render pool, for what does not depend on frames: it starts nothing, and costs nothing."""
    app = create_app(Settings(**settings), renderer=FakeRenderer)
    app.state.context = SimpleNamespace(
        settings=Settings(**settings),
        requests=Requests(),
        pool=SimpleNamespace(info={}, state="starting"),
        masks=ThreadPool(1, 8),
        streams=Streams(2),
    )
    return TestClient(app, raise_server_exceptions=False)
