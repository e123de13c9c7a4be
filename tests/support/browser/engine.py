"""What the drivers of other engines than Chromium share: a page that is sized, visited, asked and pointed at."""

import time
from abc import ABC, abstractmethod
from typing import Any


class Engine(ABC):
    """A browser with one tab."""

    hung = False
    """Whether it answers no more, and must be started anew."""

    @property
    @abstractmethod
    def complaints(self) -> list[str]:
        """What went wrong on the page since it was visited."""

    @abstractmethod
    def size(self, width: int, height: int) -> None:
        """Give the page this size, css px."""

    @abstractmethod
    def visit(self, address: str) -> None:
        """Load a page, which is there when this returns."""

    @abstractmethod
    def evaluate(self, expression: str) -> Any:
        """Return the value of an expression in the page, awaited."""

    @abstractmethod
    def act(self, actions: list[dict[str, Any]]) -> None:
        """Perform actions as both WebDrivers describe them."""

    @abstractmethod
    def close(self) -> None:
        """End the browser."""

    def until(self, condition: str, seconds: float = 120) -> None:
        deadline = time.monotonic() + seconds
        while time.monotonic() < deadline:
            if self.evaluate(condition):
                return
            time.sleep(0.1)
        raise AssertionError(f"never true: {condition}; {self.complaints}")

    def press(self, kind: str, *places: tuple[int, int]) -> None:
        """Put a pointer (``mouse`` or ``touch``) down at the first place, move it along the others and lift it."""
        (x, y), *rest = places
        actions: list[dict[str, Any]] = [{"type": "pointerMove", "x": x, "y": y}, {"type": "pointerDown", "button": 0}]
        actions += [{"type": "pointerMove", "x": x, "y": y, "duration": 50} for x, y in rest]
        actions += [{"type": "pause", "duration": 150}, {"type": "pointerUp", "button": 0}]
        source = {"type": "pointer", "id": kind, "parameters": {"pointerType": kind}, "actions": actions}
        self.act([source])
