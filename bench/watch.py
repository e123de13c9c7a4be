"""Rounds of measurement, bounded by number and by time, with a progress bar."""

import time
from collections.abc import Iterator
from contextlib import contextmanager

from rich.progress import Progress


class Watch:
    """Counts rounds. ``share``: of the rounds and the time of a full run."""

    def __init__(self, progress: Progress, share: float = 1.0) -> None:
        self._progress = progress
        self._share = share

    def rounds(self, what: str, rounds: int, seconds: float, least: int = 2) -> Iterator[int]:
        """Number the rounds until there are enough or the time is up, but never fewer than ``least``."""
        most = max(least, round(rounds * self._share))
        limit = seconds * self._share
        began = time.perf_counter()
        task = self._progress.add_task(what, total=1.0)
        for index in range(most):
            elapsed = time.perf_counter() - began
            if index >= least and elapsed >= limit:
                break
            yield index
            done = max((index + 1) / most, (time.perf_counter() - began) / limit)
            self._progress.update(task, completed=min(1.0, done))
        self._progress.update(task, completed=1.0)

    def seconds(self, seconds: float) -> float:
        """This run's share of a time that a full run spends."""
        return seconds * self._share

    @contextmanager
    def step(self, what: str) -> Iterator[None]:
        """Show that something goes on which has no rounds."""
        task = self._progress.add_task(what, total=None)
        try:
            yield
        finally:
            self._progress.update(task, total=1.0, completed=1.0)
