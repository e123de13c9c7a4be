"""Fixtures that every level shares."""

from collections.abc import Iterator

import pytest

from gpu import Probe
from report import REPORT, Report
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


@pytest.fixture(scope="session")
def report() -> Report:
    """Collects figures to print at the end of the run."""
    return REPORT


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Print what the tests measured."""
    for line in REPORT.lines():
        terminalreporter.write_line(line)
