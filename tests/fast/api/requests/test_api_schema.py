"""Every operation against its own OpenAPI description: data that fits, data that does not, wrong methods."""

import tempfile
import threading
import time
import urllib.request
from collections.abc import Iterator

import hypothesis
import pytest
import schemathesis
import uvicorn

from seafoam.api.app import create_app
from seafoam.api.settings import Settings
from support.api_fakes import FakeRenderer
from support.sweep import REST

_MEASURED = {"accuracy_width": 16, "accuracy_height": 16, "accuracy_samples": 2, "accuracy_rounds": 2}
app = create_app(
    Settings(workers=1, queue=64, max_side=64, cache=tempfile.mkdtemp(), **_MEASURED), renderer=FakeRenderer
)
schema = schemathesis.openapi.from_dict(app.openapi())


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    """Of the running app: one start for all requests, where calls of the app itself would start it for each."""
    server = uvicorn.Server(uvicorn.Config(app, port=0, log_level="warning"))
    thread = threading.Thread(target=server.run)
    thread.start()
    while not server.started:
        assert thread.is_alive()
        time.sleep(0.05)
    address = f"http://127.0.0.1:{server.servers[0].sockets[0].getsockname()[1]}"
    # Its effects need the plans of all presets, which the app makes as it starts: longer than a request waits for.
    urllib.request.urlopen(f"{address}/api/presets", timeout=120).close()
    yield address
    server.should_exit = True
    thread.join()


@pytest.fixture(autouse=True)
def _quick_masks(monkeypatch):
    monkeypatch.setattr("seafoam.api.routers.masks.ON_REQUEST_SECONDS", 0.05)
    monkeypatch.setattr("seafoam.api.routers.masks.BACKGROUND_SECONDS", 0.05)
    monkeypatch.setattr("seafoam.masks.catalogue.ON_REQUEST_SECONDS", 0.05)


SCENES = [
    "/api/plans", "/api/scenes", "/api/frames", "/api/sequences", "/api/export",
    "/api/streams", "/api/streams/{stream}",
]  # fmt: skip
"""Their bodies hold a whole scene: making one that fits its schema takes seconds."""


def check(case, address: str) -> None:
    # Some scenes fit the schema and are refused with reason: an order of two numbers, a mask nobody has.
    excluded = [schemathesis.checks.positive_data_acceptance]
    # Ten seconds, the default, are too few for plans of several tiers beside other tests.
    response = case.call(base_url=address, timeout=120)
    if response.status_code == 503 and "retry-after" in response.headers:  # workers start, or a measurement does
        excluded.append(schemathesis.checks.not_a_server_error)
    case.validate_response(response, excluded_checks=excluded)


few = hypothesis.settings(deadline=None, suppress_health_check=list(hypothesis.HealthCheck), max_examples=2)


@schema.exclude(path=SCENES).parametrize()
@few
def test_operations_are_as_described(case, address):
    check(case, address)


@REST
@schema.include(path=SCENES).parametrize()
@few
def test_operations_on_scenes_are_as_described(case, address):
    check(case, address)
