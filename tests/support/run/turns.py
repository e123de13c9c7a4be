"""Which files of tests ``make test`` runs: always those of what every change concerns, of the others a third.

The commit says which third, so that the same commit always runs the same, and what it broke is found by it or by one of
the next. All of them take two cores twice as long.
"""

from functools import cache
from pathlib import Path

TESTS = Path(__file__).parents[2]
ALWAYS = tuple(TESTS / folder for folder in ("fast/meta", "fast/project", "fast/planner", "fast/library", "gpu/smoke"))
"""Folders of files that run with every commit: rules of the code, plans, every preset drawn small."""
TURNS = 3
ALL = "all"


@cache
def turns() -> dict[Path, int]:
    """The turn of each file that has one: in rotation by the lengths of their paths, which spreads what is alike."""
    files = (path for path in TESTS.rglob("test_*.py") if not any(folder in path.parents for folder in ALWAYS))
    ordered = sorted(files, key=lambda path: (len(path.as_posix()), path))
    return {path: i % TURNS for i, path in enumerate(ordered)}


def waits(file: Path, turn: str) -> bool:
    """Whether a file of tests waits for another turn. ``turn``: the commit, a hexadecimal number; or all."""
    return turn != ALL and file in turns() and turns()[file] != int(turn, 16) % TURNS
