"""The API in this process, with renderers that only pretend to draw or with GL, and what tests ask of it."""

import io
from collections.abc import Iterator
from contextlib import contextmanager

from PIL import Image
from starlette.testclient import TestClient

from seafoam.api.app import create_app
from seafoam.api.settings import Settings
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
