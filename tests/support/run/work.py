"""What a group of ``make test`` does that takes long, counted: the same on every machine, where its time is not.

A run of a group that does more than pyproject.toml grants it fails: ``[tool.seafoam.budget.work]``. What servers and
browsers do by themselves is counted by their number alone.
"""

import json
import multiprocessing.process
import os
import subprocess
from collections import Counter
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import moderngl
import psutil
import pytest
from playwright.sync_api import Browser, BrowserType

from seafoam.planner import planner
from seafoam.reference.renderer.shade import SampleShader
from seafoam.render.gl.executor import Executor

COUNTED: Mapping[str, tuple[tuple[Any, str], ...]] = {
    "plans": ((planner, "linked_plan"),),
    "programs": ((moderngl.Context, "program"),),
    "frames": ((Executor, "render"),),
    "samples": ((SampleShader, "shade"),),
    "processes": ((subprocess.Popen, "__init__"), (multiprocessing.process.BaseProcess, "start")),
    "browsers": ((BrowserType, "launch"),),
    "pages": ((Browser, "new_page"), (Browser, "new_context")),
}
"""By kind of work: the calls that do it, in the tests' own process. ``samples`` are the float64 reference's."""
SLOWEST = 12
"""Files whose processor time is told."""


class Work:
    """The plugin: counts, compares with ``granted`` if it is given, and tells which files took most processor time."""

    def __init__(self, granted: Mapping[str, int] | None, spent: Path | None = None) -> None:
        self._granted, self._file_of_spent = granted, spent
        self._done: Counter[str] = Counter()
        self._patch = pytest.MonkeyPatch()
        self._spent: Counter[str] = Counter()
        self._file = "start, collection"
        self._at = 0.0
        for kind, places in COUNTED.items():
            for owner, name in places:
                self._patch.setattr(owner, name, self._counting(kind, getattr(owner, name)))

    def _counting(self, kind: str, call: Callable[..., Any]) -> Callable[..., Any]:
        def counted(*given: Any, **named: Any) -> Any:
            self._done[kind] += len(given[1]) if kind == "samples" else 1
            return call(*given, **named)

        return counted

    def _turn(self, to: str) -> None:
        now = processor_seconds()
        # What processes that nobody awaited took is gone with them.
        self._spent[self._file] += max(now - self._at, 0.0)
        self._file, self._at = to, now

    def over(self) -> list[str]:
        """What was done more often than is granted."""
        granted = self._granted or {}
        return [
            f"{kind}: {self._done[kind]}, granted {most}" for kind, most in granted.items() if self._done[kind] > most
        ]

    def pytest_runtest_logstart(self, location: tuple[str, int | None, str]) -> None:
        # Of browsers after each test, before they close.
        if location[0] != self._file or self._done["browsers"]:
            self._turn(location[0])

    @pytest.hookimpl(trylast=True)
    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        self._turn("end")
        if self._file_of_spent is not None:
            with self._file_of_spent.open("a", encoding="utf-8") as file:  # of all groups, a line each: spent.py
                file.write(json.dumps(self._spent) + "\n")
        self._patch.undo()
        if self.over():
            session.exitstatus = pytest.ExitCode.TESTS_FAILED

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        terminalreporter.write_line("Work: " + ", ".join(f"{kind} {self._done[kind]}" for kind in COUNTED))
        for said in self.over():
            terminalreporter.write_line(f"FAILED: more work than [tool.seafoam.budget.work] grants: {said}", red=True)
        slowest = ", ".join(f"{Path(file).name} {seconds:.0f}" for file, seconds in self._spent.most_common(SLOWEST))
        terminalreporter.write_line(f"Processor time: {self._spent.total():.0f} s; {slowest}")


def processor_seconds() -> float:
    """What this process and those below it have taken, ended or not."""
    spent = sum(os.times()[:4])
    for below in psutil.Process().children(recursive=True):
        try:
            spent += sum(below.cpu_times()[:4])
        except psutil.Error:  # it has just ended
            continue
    return spent
