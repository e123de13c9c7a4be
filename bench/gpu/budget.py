"""Time that is kept to by measuring: nothing is begun that has shown to take longer than what is left."""

import time
from collections.abc import Callable


class Budget:
    """Seconds from now on, and the longest that each kind of work has taken so far."""

    def __init__(self, seconds: float, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._began = clock()
        self._seconds = seconds
        self._longest: dict[str, float] = {}

    @property
    def spent(self) -> float:
        """Seconds since the beginning."""
        return self._clock() - self._began

    def left(self, reserved: float = 0.0) -> float:
        """Seconds that remain, but for those reserved for later work; 0 when there are none."""
        return max(0.0, self._seconds - reserved - self.spent)

    def took(self, kind: str, seconds: float) -> None:
        """Remember how long a piece of work has taken."""
        self._longest[kind] = max(seconds, self._longest.get(kind, 0.0))

    def has_room(self, kind: str, reserved: float = 0.0) -> bool:
        """Whether another piece of this kind ends in time; of a kind not seen yet, one as long as any."""
        expected = self._longest.get(kind, max(self._longest.values(), default=0.0))
        return expected < self.left(reserved)
