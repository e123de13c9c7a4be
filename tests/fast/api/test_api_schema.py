"""Every operation against its own OpenAPI description: data that fits, data that does not, wrong methods."""

import tempfile

import hypothesis
import pytest
import schemathesis

from seafoam.api.app import create_app
from seafoam.api.settings import Settings
from support.api_fakes import FakeRenderer

_MEASURED = {"accuracy_width": 16, "accuracy_height": 16, "accuracy_samples": 2, "accuracy_rounds": 2}
app = create_app(
    Settings(workers=1, queue=64, max_side=64, cache=tempfile.mkdtemp(), **_MEASURED), renderer=FakeRenderer
)
schema = schemathesis.openapi.from_dict(app.openapi())
schema.app = app


@pytest.fixture(autouse=True)
def _quick_masks(monkeypatch):
    monkeypatch.setattr("seafoam.api.routers.masks.ON_REQUEST_SECONDS", 0.05)
    monkeypatch.setattr("seafoam.masks.catalogue.ON_REQUEST_SECONDS", 0.05)


@schema.parametrize()
@hypothesis.settings(deadline=None, suppress_health_check=list(hypothesis.HealthCheck), max_examples=4)
def test_operations_are_as_described(case):
    # Some scenes fit the schema and are refused with reason: an order of two numbers, a mask nobody has.
    excluded = [schemathesis.checks.positive_data_acceptance]
    response = case.call()
    if response.status_code == 503 and "retry-after" in response.headers:  # workers start, or a measurement does
        excluded.append(schemathesis.checks.not_a_server_error)
    case.validate_response(response, excluded_checks=excluded)
