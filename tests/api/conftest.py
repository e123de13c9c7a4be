from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager

import pytest
from api_fakes import FakeRenderer, no_renderer
from starlette.testclient import TestClient

from seafoam.api.app import create_app
from seafoam.api.settings import Settings


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark what draws; the rest has renderers that only pretend to."""
    for item in items:
        if isinstance(item, pytest.Function) and "real" in item.fixturenames:
            item.add_marker("real")


@contextmanager
def serving(renderer=FakeRenderer, **settings) -> Iterator[TestClient]:
    """A running app, ready or found unable."""
    app = create_app(Settings(**{"workers": 1, **settings}), renderer=renderer)
    with TestClient(app, raise_server_exceptions=False) as client:
        yield client


@pytest.fixture(scope="package")
def serve() -> Callable[..., AbstractContextManager[TestClient]]:
    return serving


@pytest.fixture(scope="package")
def client() -> Iterator[TestClient]:
    """With a renderer that draws gradients."""
    with serving() as running:
        yield running


@pytest.fixture(scope="package")
def without_gl() -> Iterator[TestClient]:
    """On a machine without GL."""
    with serving(no_renderer) as running:
        running.get("/api/frames/default.png")  # waits until it is known
        yield running


@pytest.fixture(scope="package")
def real() -> Iterator[TestClient]:
    """With the GL executor."""
    with serving(None, deadline=60.0) as running:
        response = running.get("/api/frames/default.png?width=8&height=8")
        assert response.status_code == 200, response.text
        yield running
