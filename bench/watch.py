"""Rounds of measurement, bounded by number and by time, with a progress bar."""

import time
from collections.abc import Iterator

from rich.progress import Progress


class Watch:
    """Counts rounds. ``share``: of the rounds and the time of a full run."""

    def __init__(self, progress: Progress, share: float = 1.0) -> None:
        self._progress = progress
        self._share = share

    def rounds(self, what: str, rounds: int, seconds: float) -> Iterator[int]:
        """Number the rounds until there are enough or the time is up; there are always two."""
        most = max(2, round(rounds * self._share))
        limit = seconds * self._share
        began = time.perf_counter()
        task = self._progress.add_task(what, total=1.0)
        for index in range(most):
            spent = time.perf_counter() - began
            if index >= 2 and spent >= limit:
                break
            yield index
            done = max((index + 1) / most, (time.perf_counter() - began) / limit)
            self._progress.update(task, completed=min(1.0, done))
        self._progress.update(task, completed=1.0)

    def seconds(self, seconds: float) -> float:
        """This run's share of a time that a full run spends."""
        return seconds * self._share

    def step(self, what: str) -> None:
        """Say what is being prepared."""
        self._progress.console.print(what, style="dim")
