"""Fixtures that every level shares."""

import json
import os
import sys
import tomllib
from collections.abc import Generator, Iterator
from functools import _lru_cache_wrapper, cache
from pathlib import Path
from typing import Any

import pytest

from seafoam.render.gl.executor import Executor
from support.probe import Probe
from support.report import REPORT, Report
from support.run.room import LIMIT, Room, give_back, resident
from support.run.turns import ALL, waits
from support.run.work import Work
from support.sweep import REST, leave_to_sweep

# llvmpipe compiles in half the time without LLVM's optimisations, and draws the same bytes (test_driver.py); most of
# what tests draw is drawn once, and small. Servers and browsers that they start inherit it.
os.environ["GALLIVM_PERF"] = "nopt"
# One for all: servers would each keep their own beside their frames, and compile every program again.
CACHES = os.environ.get("XDG_CACHE_HOME") or str(Path.home() / ".cache")
os.environ |= {"MESA_SHADER_CACHE_DIR": CACHES, "MESA_SHADER_CACHE_MAX_SIZE": "2G"}
# Processes that are spawned run the file of their parent's __main__ first: pytest's, whose import they need not.
vars(sys.modules["__main__"]).pop("__file__", None)
# What earlier runs drew must not answer for what is drawn now.
os.environ |= {"SEAFOAM_CACHE_SIZE": "0", "SEAFOAM_CACHE_MEMORY": "0"}
# Many servers are started for a few requests each, and two cores draw for all of them.
os.environ["SEAFOAM_COMPILE_AHEAD"] = "false"


BROWSER = Path(__file__).with_name("browser")
DRAWING = (Path(__file__).with_name("gpu"), BROWSER)
"""Where a case takes seconds."""
MOST = 2
"""Cases of one test function there, but for the sweep."""


@cache
def _executor() -> Executor:
    return Executor()


def pytest_configure(config: pytest.Config) -> None:
    """Let no process grow too large, and no group of ``make test`` do more than it is granted."""
    config.pluginmanager.register(Room())
    granted = None
    if (group := config.getoption("group")) is not None:
        project = tomllib.loads((config.rootpath / "pyproject.toml").read_text(encoding="utf-8"))
        granted = project["tool"]["seafoam"]["budget"]["work"].get(group)
    config.pluginmanager.register(Work(granted, config.getoption("spent")))


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    return waits(collection_path, config.getoption("turn")) or None


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_pycollect_makeitem(collector: pytest.Collector, obj: object) -> Generator[None, Any, Any]:
    """Without the sweep no cases are made of functions that are its alone: some take seconds to make."""
    made = yield
    left_out = collector.config.getoption("markexpr") == f"not {REST.name}"
    return [] if left_out and REST.mark in getattr(obj, "pytestmark", ()) else made


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Browsers last: Playwright leaves an event loop running in this thread, and the API's clients start their own.

    Of large tables a few cases, but for the sweep.
    """
    items.sort(key=lambda item: BROWSER in item.path.parents)
    leave_to_sweep((item for item in items if any(folder in item.path.parents for folder in DRAWING)), MOST)


def pytest_unconfigure() -> None:
    """Give the context back."""
    if _executor.cache_info().currsize:
        _executor().close()
        _executor.cache_clear()


@pytest.fixture(scope="session")
def executor() -> Executor:
    """The one GL context of the test process."""
    return _executor()


least = 0
"""Bytes that stay when the executor has forgotten: what else the process keeps."""


def _forget_results() -> None:
    """Empty the package's caches of functions: plans hold their shaders' texts, textures and truth their arrays."""
    # Not from gc.get_objects(): it holds what other threads are still building, and their tuples cannot grow then.
    for name, module in list(sys.modules.items()):
        if name.partition(".")[0] == "seafoam":
            for owner in (module, *(found for found in vars(module).values() if isinstance(found, type))):
                for found in list(vars(owner).values()):
                    if isinstance(found, _lru_cache_wrapper):
                        found.cache_clear()


@pytest.fixture(autouse=True)
def _room() -> Iterator[None]:
    """After a test, have the executor forget what it keeps for later frames, once that is too much."""
    global least
    yield
    most = max(LIMIT // 2, least + LIMIT // 10)
    if _executor.cache_info().currsize and resident() > most:
        give_back()
        if resident() > most:
            _executor().forget()
            if resident() > 3 * LIMIT // 5:
                _forget_results()
            give_back()
            least = resident()


@pytest.fixture(scope="session")
def probe(executor: Executor) -> Probe:
    """Runs shader functions on arrays."""
    return Probe(executor)


@pytest.fixture(scope="session")
def report() -> Report:
    """Collects figures to print at the end of the run."""
    return REPORT


def pytest_addoption(parser: pytest.Parser) -> None:
    """Where to write what the tests measured, and what may be done."""
    parser.addoption("--turn", default=ALL, help="the commit, which says what half of the files of tests runs; or all")
    parser.addoption("--group", help="fail if the run does more work than pyproject.toml grants this group")
    parser.addoption("--spent", type=Path, help="add the processor time of each file of tests to this file")
    parser.addoption("--figures", type=Path, help="write what the tests measure to this file too, as JSON")


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter, config: pytest.Config) -> None:
    """Print what the tests measured, and write it where it is asked for."""
    for line in REPORT.lines():
        terminalreporter.write_line(line)
    if (file := config.getoption("figures")) is not None:
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(json.dumps(REPORT.tables, ensure_ascii=False), encoding="utf-8")
