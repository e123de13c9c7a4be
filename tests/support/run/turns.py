"""Which files of tests ``make test`` runs: always those of what every change concerns, of the others a third.

The commit says which third, so that the same commit always runs the same, and what it broke is found by it or by one of
the next. All of them take two cores twice as long.
"""

import hashlib
from pathlib import Path

TESTS = Path(__file__).parents[2]
ALWAYS = tuple(TESTS / folder for folder in ("fast/meta", "fast/project", "fast/planner", "fast/library", "gpu/smoke"))
"""Folders of files that run with every commit: rules of the code, plans, every preset drawn small."""
TURNS = 3
ALL = "all"


def turn_of(file: Path) -> int | None:
    """The turn of a file of tests, by a hash of its path, so that others that come or go do not move it; None: every.

    Of the hashes of a standard library it is that which spreads today's times best, to 2 %.
    """
    if not file.name.startswith("test_") or any(folder in file.parents for folder in ALWAYS):
        return None
    name = file.relative_to(TESTS).as_posix().encode()
    return int(hashlib.md5(name, usedforsecurity=False).hexdigest(), 16) % TURNS


def waits(file: Path, turn: str) -> bool:
    """Whether a file of tests waits for another turn. ``turn``: the commit, a hexadecimal number; or all."""
    return turn != ALL and turn_of(file) not in (None, int(turn, 16) % TURNS)
