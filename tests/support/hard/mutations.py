"""Guards taken out: a copy of the package in which one text stands in another's place, and what tests say of it.

A hard case tells of a failure and of the guard against it. Whether the guard guards is shown by its mutation: the
sources are copied, the guard's text is replaced, and the case is drawn by a process of its own, whose pictures must
then fail what the case's own pictures pass. A guard that these do not show names the test that fails without it.
"""

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
LIMIT = 300.0
"""Seconds after which a process counts as broken: a search without its guard may never end."""


@dataclass(frozen=True)
class Mutation:
    """``replaced``: text by text, in ``file``, a path below ``shaders`` (GLSL) or ``server/seafoam`` (Python).

    ``test``: the test that fails with it, as pytest names it from the repository's root; empty: the hard case itself.
    ``error``: words of the error with which the process ends, where it draws no picture without the guard.
    """

    file: str
    replaced: tuple[tuple[str, str], ...]
    test: str = ""
    error: str = ""

    @property
    def path(self) -> Path:
        """The file's path below the repository's root."""
        return Path("shaders" if self.file.endswith(".glsl") else "server/seafoam") / self.file

    def applied(self, text: str) -> str:
        """Return the file's text with the replacements. Raises ``ValueError`` where a text is not in it."""
        for before, after in self.replaced:
            if before not in text:
                raise ValueError(f"{self.file} has no text {before!r}")
            text = text.replace(before, after)
        return text


_PLACE = "(rule.k[0] * x + rule.k[1] * z)"
IN_FLOAT32 = (
    Mutation(
        "framegraph/evaluation.py",
        (
            (
                f"rule.offset + rule.rate * state.time + {_PLACE}",
                f"float(np.float32(rule.offset) + np.float32(rule.rate * state.time) + np.float32({_PLACE}))",
            ),
            (
                f"rule.offset + (rule.rate or 0.0) * state.time + {_PLACE}",
                f"float(np.float32(rule.offset) + np.float32((rule.rate or 0.0) * state.time) + np.float32({_PLACE}))",
            ),
            (
                "_modulo(state.time + rule.offset, rule.period)",
                "_modulo(float(np.float32(state.time) + np.float32(rule.offset)), rule.period)",
            ),
        ),
    ),
)
"""Times and places reduced in float32, as GLSL would."""


@contextmanager
def copied(folder: Path, mutations: tuple[Mutation, ...]) -> Iterator[dict[str, str]]:
    """A copy of the sources with mutations in ``folder``, as the environment of a process that imports it."""
    for name in ("server", "shaders"):
        shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
    for name in ("masks", "webclient"):
        (folder / name).symlink_to(ROOT / name)
    for mutation in mutations:
        file = folder / mutation.path
        file.write_text(mutation.applied(file.read_text(encoding="utf-8")), encoding="utf-8")
    path = os.pathsep.join(map(str, (folder / "server", ROOT / "tests", ROOT)))
    # With CI set, no check is left out because it passed before, with its guard.
    yield {**os.environ, "PYTHONPATH": path, "PYTHONDONTWRITEBYTECODE": "1", "CI": "1"}
    shutil.rmtree(folder)


def run(environment: dict[str, str], *arguments: str) -> str | None:
    """Run Python in an environment. Return the end of what it printed where it failed, None where it did not."""
    command = [sys.executable, *arguments]
    try:
        ended = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, timeout=LIMIT)
    except subprocess.TimeoutExpired:
        return f"not ended after {LIMIT:g} s"
    return (ended.stdout + ended.stderr)[-2000:] if ended.returncode else None
