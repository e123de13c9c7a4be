"""Tables of results, as text and as JSON."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, is_dataclass
from statistics import median, quantiles
from textwrap import wrap
from typing import Any

WIDTH = 116
"""Width of running text, characters."""


@dataclass(frozen=True)
class Spread:
    """A median and the quartiles around it."""

    median: float
    low: float
    high: float

    @classmethod
    def of(cls, values: Sequence[float]) -> "Spread":
        """The spread of some values, at least one."""
        if len(values) == 1:
            return cls(values[0], values[0], values[0])
        low, _, high = quantiles(values, n=4, method="inclusive")
        return cls(median(values), low, high)


def extra(ratio: Spread) -> str:
    """A ratio as a relative change, with its interquartile range: ``+1.2 % (-0.3 to +2.5)``."""
    middle, low, high = (100.0 * (value - 1.0) for value in (ratio.median, ratio.low, ratio.high))
    return f"{middle:+.1f} %  ({low:+.1f} to {high:+.1f})"


def times(ratio: Spread) -> str:
    """A ratio as a factor, with its interquartile range."""
    return f"{ratio.median:.2f}  ({ratio.low:.2f} to {ratio.high:.2f})"


def percent(share: float) -> str:
    """A signed share."""
    return f"{100.0 * share:+.2f} %"


def ms(seconds: float) -> str:
    """Seconds as milliseconds, with about three digits."""
    value = 1000.0 * seconds
    return f"{value:.0f}" if value >= 100 else f"{value:.1f}" if value >= 1 else f"{value:.2f}"


def count(number: int) -> str:
    """An integer with thousands separators."""
    return f"{number:,}"


def lines(about: Mapping[str, str]) -> str:
    """Names and values, a line each."""
    width = max(map(len, about))
    return "\n".join(f"{name.ljust(width)}  {value}" for name, value in about.items())


@dataclass(frozen=True)
class Column:
    """A column: its heading, its key in JSON, and how its values are shown."""

    key: str
    heading: str
    show: Callable[[Any], str] = str


def ratio_columns(show: Callable[[Any], str]) -> tuple[Column, Column]:
    """Columns for the result of ``bench.drawn.frames.ratios``."""
    return Column("cpu_ratio", "processor time", show), Column("wall_ratio", "wall time", show)


@dataclass(frozen=True)
class Table:
    """Rows of results. ``note``: their description."""

    title: str
    note: str
    columns: tuple[Column, ...]
    rows: list[tuple[Any, ...]]

    def text(self) -> str:
        """The table as plain text: columns of words left-aligned, figures right-aligned."""
        shown = [[column.heading for column in self.columns]]
        for row in self.rows:
            cells = zip(self.columns, row, strict=True)
            shown.append(["" if value is None else column.show(value) for column, value in cells])
        widths = [max(len(line[i]) for line in shown) for i in range(len(self.columns))]
        words = [column.show is str for column in self.columns]
        lines = [
            "  ".join(
                cell.ljust(width) if left else cell.rjust(width)
                for cell, width, left in zip(line, widths, words, strict=True)
            ).rstrip()
            for line in shown
        ]
        rule = "  ".join("-" * width for width in widths)
        return "\n".join([self.title, *wrap(self.note, WIDTH), "", lines[0], rule, *lines[1:]])

    def json(self) -> dict[str, Any]:
        """The table as JSON values; times in seconds, ratios as ratios."""
        keys = [column.key for column in self.columns]
        rows = [{key: _plain(value) for key, value in zip(keys, row, strict=True)} for row in self.rows]
        return {"title": self.title, "note": self.note, "rows": rows}


def _plain(value: Any) -> Any:
    return asdict(value) if is_dataclass(value) and not isinstance(value, type) else value
