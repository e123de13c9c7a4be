"""Fixtures that every level shares."""

from functools import cache

import pytest

import inputs
from gpu import Probe
from report import REPORT, Report
from seafoam.render.executor import Executor


@cache
def _executor() -> Executor:
    return Executor()


def pytest_configure(config: pytest.Config) -> None:
    """Remember checks that passed."""
    config.pluginmanager.register(inputs.memo(lambda: _executor().info))


def pytest_unconfigure() -> None:
    """Give the context back."""
    if _executor.cache_info().currsize:
        _executor().close()
        _executor.cache_clear()


@pytest.fixture(scope="session")
def executor() -> Executor:
    """The one GL context of the test process."""
    return _executor()


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
