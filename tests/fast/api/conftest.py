from collections.abc import Callable, Iterator
from typing import Any

import pytest
import schemathesis
from starlette.testclient import TestClient

from support.api_fakes import no_renderer
from support.serving import document, serving


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
def described() -> Callable[[str, Any], None]:
    """Checks that the OpenAPI document has the answer of a GET: its status, media type, headers and content."""
    schema = schemathesis.openapi.from_dict(document())
    return lambda path, response: schema[path]["GET"].validate_response(response)
