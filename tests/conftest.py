"""Fixtures that every level shares."""

from collections.abc import Iterator

import pytest

from gpu import Probe
from seafoam.render.executor import Executor


@pytest.fixture(scope="session")
def executor() -> Iterator[Executor]:
    """The one GL context of the test process."""
    made = Executor()
    yield made
    made.close()


@pytest.fixture(scope="session")
def probe(executor: Executor) -> Probe:
    """Runs shader functions on arrays."""
    return Probe(executor)
