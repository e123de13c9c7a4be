"""A run of tests that does more than its group is granted, or in which a process grows too large, fails and says so;
which files, and what else, it runs."""

import os
import re
import subprocess
import sys
from itertools import combinations
from pathlib import Path

import pytest

from support.run import turns

ROOT = Path(__file__).parents[3]
CONFTEST = """
from support.run.room import Room
from support.run.work import Work

def pytest_configure(config):
    for plugin in ({plugins},):
        config.pluginmanager.register(plugin)
"""
PLANS = """
import subprocess, sys
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.scene import Scene

def test_two_plans_and_a_process():
    for tier in ("fast", "standard", "fast"):
        make_plan(Scene(), TIERS[tier])
    subprocess.run([sys.executable, "-c", "pass"], check=True)
"""
LARGE = """
import subprocess, sys

def test_large():
    inner = "len(b'x' * int(3e8))"
    subprocess.run([sys.executable, "-c", f"import subprocess, sys; subprocess.run([sys.executable, '-c', {inner!r}])"])
"""
"""By a grandchild."""


@pytest.fixture
def run(pytester, monkeypatch):
    """Runs tests with plugins, in a process of its own: the most that this one ever took is not to be had back.

    A shell starts it, as what this one forks counts this one's memory as its own.
    """
    monkeypatch.setenv("PYTHONPATH", str(Path(__file__).parents[2]))
    monkeypatch.setenv("PYTEST_DISABLE_PLUGIN_AUTOLOAD", "1")

    def call(plugins: list[str], tests: str, passed: int) -> pytest.RunResult:
        pytester.makeconftest(CONFTEST.format(plugins=", ".join(plugins)))
        pytester.makepyfile(tests)
        args = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider"]
        result = pytester.run("sh", "-c", '"$@"; exit $?', "sh", *args)
        result.assert_outcomes(passed=passed)
        return result

    return call


def test_a_group_that_does_what_it_may_in_processes_that_stay_small_passes(run) -> None:
    result = run(["Work({'plans': 2, 'processes': 2})", "Room(1_000_000_000)"], PLANS + LARGE, 2)
    assert result.ret == 0
    result.stdout.fnmatch_lines(["Work: plans 2, programs 0, frames 0, samples 0, processes 2*"])


def test_no_group_does_more_than_it_is_granted_and_no_process_may_grow_past_the_limit(run) -> None:
    result = run(["Work({'plans': 1})", "Room(200_000_000)"], PLANS + LARGE, 2)
    assert result.ret == 1
    result.stdout.fnmatch_lines_random(
        ["FAILED: more work than * grants: plans: 2, granted 1", "FAILED: Memory at its most*"]
    )


def test_every_file_of_tests_runs_with_every_commit_or_with_one_in_three() -> None:
    files = {*turns.TESTS.rglob("test_*.py")}
    parts = [{file for file in files if not turns.waits(file, turn)} for turn in ("b9fa5c25", "1", "2")]
    always = {file for file in files if any(folder in file.parents for folder in turns.ALWAYS)}
    assert set[Path]().union(*parts) == files == {file for file in files if not turns.waits(file, turns.ALL)}
    assert all(one & other == always for one, other in combinations(parts, 2))
    assert len(always) < len(files) / 5


def test_make_test_lints_checks_types_and_runs_every_group() -> None:
    plain = {key: value for key, value in os.environ.items() if not key.startswith("MAKE")}
    asked = ["make", "-n", "test", "TURN=1"]
    told = subprocess.run(asked, cwd=turns.TESTS.parent, env=plain, capture_output=True, text=True, check=True).stdout
    groups = [f"--group {group} " for group in ("live", "truth", "gpu", "fast")]
    for command in (
        "ruff check .",
        "ruff format --check .",
        "/mypy",
        "/lint-imports",
        "npm run lint",
        "npm test",
        *groups,
    ):
        assert command in told, command


def test_every_test_that_a_fault_has_is_there() -> None:
    text = (ROOT / "docs" / "tests.md").read_text(encoding="utf-8")
    named = [(f, f"def {name}(") for f, name in re.findall(r"`(tests/[\w/]+\.py)::(\w+)`", text)]
    named += re.findall(r"`(webclient/tests/[\w/]+\.test\.ts)::([^`]+)`", text)
    assert len(named) > 50
    assert [(f, said) for f, said in named if said not in (ROOT / f).read_text(encoding="utf-8")] == []
