"""Which files of tests ``make test`` runs: always those of what every change concerns, of the others half.

The commit says which half, so that the same commit always runs the same, and what it broke is found by it or by one of
the next. All of them take two cores twice as long.
"""

from functools import cache
from pathlib import Path

TESTS = Path(__file__).parents[2]
ALWAYS = tuple(
    TESTS / folder
    for folder in ("fast/meta", "fast/project", "fast/planner", "fast/library", "gpu/smoke", "gpu/packaging")
)
"""Folders of files that run with every commit: rules of the code, plans, every preset drawn small, the wheel."""
ALL = "all"


@cache
def halves() -> tuple[frozenset[Path], frozenset[Path]]:
    """Files of the one half and of the other: in turn, by their paths."""
    files = sorted(path for path in TESTS.rglob("test_*.py") if not any(folder in path.parents for folder in ALWAYS))
    return frozenset(files[::2]), frozenset(files[1::2])


def waits(file: Path, turn: str) -> bool:
    """Whether a file of tests waits for another turn. ``turn``: hexadecimal, of which the last digit counts, or all."""
    return turn != ALL and file in halves()[1 - int(turn, 16) % 2]
