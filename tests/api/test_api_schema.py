"""Every operation against its own OpenAPI description: data that fits, data that does not, wrong methods."""

import hypothesis
import pytest
import schemathesis
from api_fakes import FakeRenderer

from seafoam.api.app import create_app
from seafoam.api.settings import Settings

app = create_app(Settings(workers=1, queue=64, max_side=64), renderer=FakeRenderer)
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
    if case.path == "/readyz":  # 503 is its answer while the workers start
        excluded.append(schemathesis.checks.not_a_server_error)
    case.call_and_validate(excluded_checks=excluded)
