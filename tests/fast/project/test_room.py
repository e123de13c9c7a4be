"""A run in which a process grows too large fails."""

import sys
from pathlib import Path

import pytest

CONFTEST = """
from support.run.room import Room

def pytest_configure(config):
    config.pluginmanager.register(Room({limit}))
"""
CHECKS = {
    "itself": "def test_large(): assert len(b'x' * int(3e8))",
    "a child": """
import subprocess, sys

def test_large():
    subprocess.run([sys.executable, "-c", "len(b'x' * int(3e8))"], check=True)
""",
    "a grandchild": """
import subprocess, sys

def test_large():
    inner = "len(b'x' * int(3e8))"
    subprocess.run([sys.executable, "-c", f"import subprocess, sys; subprocess.run([sys.executable, '-c', {inner!r}])"])
""",
}


@pytest.mark.parametrize(
    ("who", "limit", "code"), [*((who, 200_000_000, 1) for who in CHECKS), ("a grandchild", 1_000_000_000, 0)]
)
def test_no_process_may_grow_past_the_limit(
    pytester: pytest.Pytester, monkeypatch: pytest.MonkeyPatch, who: str, limit: int, code: int
) -> None:
    monkeypatch.setenv("PYTHONPATH", str(Path(__file__).parents[2]))
    monkeypatch.setenv("PYTEST_DISABLE_PLUGIN_AUTOLOAD", "1")
    pytester.makeconftest(CONFTEST.format(limit=limit))
    pytester.makepyfile(CHECKS[who])
    # In a process of its own: the most that this one ever took is not to be had back. A shell starts it, as what this
    # one forks counts this one's memory as its own.
    args = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider"]
    result = pytester.run("sh", "-c", '"$@"; exit $?', "sh", *args)
    result.assert_outcomes(passed=1)
    assert result.ret == code
    result.stdout.fnmatch_lines("FAILED: Memory at its most*" if code else "Memory at its most*")
