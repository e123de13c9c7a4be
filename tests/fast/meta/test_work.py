"""A run of tests that does more than its group is granted fails, and says what."""

import sys
from pathlib import Path

import pytest

CONFTEST = """
from support.run.work import Work

def pytest_configure(config):
    config.pluginmanager.register(Work({granted}))
"""
CHECK = """
import subprocess, sys
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.scene.models import Scene

def test_two_plans_and_a_process():
    for tier in ("draft", "standard", "draft"):
        make_plan(Scene(), TIERS[tier])
    subprocess.run([sys.executable, "-c", "pass"], check=True)
"""


@pytest.mark.parametrize(
    ("granted", "over"),
    [
        (None, ""),
        ({"plans": 2, "processes": 1}, ""),
        ({"plans": 1, "processes": 1}, "plans: 2, granted 1"),
        ({"plans": 2, "processes": 0}, "processes: 1, granted 0"),
    ],
)
def test_no_group_does_more_than_it_is_granted(
    pytester: pytest.Pytester, monkeypatch: pytest.MonkeyPatch, granted: dict[str, int] | None, over: str
) -> None:
    monkeypatch.setenv("PYTHONPATH", str(Path(__file__).parents[2]))
    monkeypatch.setenv("PYTEST_DISABLE_PLUGIN_AUTOLOAD", "1")
    pytester.makeconftest(CONFTEST.format(granted=granted))
    pytester.makepyfile(CHECK)
    result = pytester.run(sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider")
    result.assert_outcomes(passed=1)
    assert result.ret == (1 if over else 0)
    result.stdout.fnmatch_lines(["Work: plans 2, programs 0, frames 0, samples 0, processes 1*"])
    if over:
        result.stdout.fnmatch_lines([f"FAILED: more work than * grants: {over}"])
