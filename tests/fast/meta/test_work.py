"""A run of tests that does more than its group is granted, or in which a process grows too large, fails and says so."""

import sys
from pathlib import Path

import pytest

CONFTEST = """
from support.run.room import Room
from support.run.work import Work

def pytest_configure(config):
    config.pluginmanager.register({plugin})
"""
PLANS = """
import subprocess, sys
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.scene.models import Scene

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
    """Runs a test with a plugin, in a process of its own: the most that this one ever took is not to be had back.

    A shell starts it, as what this one forks counts this one's memory as its own.
    """
    monkeypatch.setenv("PYTHONPATH", str(Path(__file__).parents[2]))
    monkeypatch.setenv("PYTEST_DISABLE_PLUGIN_AUTOLOAD", "1")

    def call(plugin: str, test: str) -> pytest.RunResult:
        pytester.makeconftest(CONFTEST.format(plugin=plugin))
        pytester.makepyfile(test)
        args = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider"]
        result = pytester.run("sh", "-c", '"$@"; exit $?', "sh", *args)
        result.assert_outcomes(passed=1)
        return result

    return call


@pytest.mark.parametrize(("plans", "over"), [(2, ""), (1, "plans: 2, granted 1")])
def test_no_group_does_more_than_it_is_granted(run, plans: int, over: str) -> None:
    result = run(f"Work({{'plans': {plans}, 'processes': 1}})", PLANS)
    assert result.ret == (1 if over else 0)
    result.stdout.fnmatch_lines(["Work: plans 2, programs 0, frames 0, samples 0, processes 1*"])
    if over:
        result.stdout.fnmatch_lines([f"FAILED: more work than * grants: {over}"])


@pytest.mark.parametrize(("limit", "code"), [(200_000_000, 1), (1_000_000_000, 0)])
def test_no_process_may_grow_past_the_limit(run, limit: int, code: int) -> None:
    result = run(f"Room({limit})", LARGE)
    assert result.ret == code
    result.stdout.fnmatch_lines("FAILED: Memory at its most*" if code else "Memory at its most*")
