from collections.abc import Iterator

import pytest
from starlette.testclient import TestClient

from support.api_fakes import no_renderer
from support.serving import serving


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
