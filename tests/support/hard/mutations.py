"""Guards taken out: a copy of the package in which one text stands in another's place, and what tests say of it.

A hard case tells of a failure and of the guard against it. Whether the guard guards is shown by its mutation: the
sources are copied, the guard's text is replaced, and the case is drawn by a process of its own, whose pictures must
then fail what the case's own pictures pass.
"""

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
LIMIT = 300.0
"""Seconds after which a process counts as broken: a search without its guard may never end."""
Replaced = Mapping[str, Mapping[str, str]]
"""What stands in a text's place, by the file, a path below ``shaders`` (GLSL) or ``server/seafoam``, and the text."""
_WAY = "(rule.k[0] * x + rule.k[1] * z)"
IN_FLOAT32 = {
    "framegraph/evaluation.py": {
        f"rule.offset + (rule.rate or 0.0) * state.time + {_WAY}": "float(np.float32(rule.offset)"
        f" + np.float32((rule.rate or 0.0) * state.time) + np.float32({_WAY}))",
        "_modulo(time + rule.offset, rule.period)": "_modulo(float(np.float32(time)"
        " + np.float32(rule.offset)), rule.period)",
    }
}
"""Times and places reduced in float32, as GLSL would."""


def source(name: str, root: Path = ROOT) -> Path:
    """The file of :data:`Replaced` below a copy of the project."""
    return root / ("shaders" if name.endswith(".glsl") else "server/seafoam") / name


@contextmanager
def copied(folder: Path, replaced: Replaced) -> Iterator[dict[str, str]]:
    """A copy of the sources, mutated, in ``folder``, as the environment of a process that imports it.

    Raises ``ValueError`` where a text is not there.
    """
    for name in ("server", "shaders"):
        shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
    for name in ("masks", "webclient"):
        (folder / name).symlink_to(ROOT / name)
    for name, texts in replaced.items():
        file = source(name, folder)
        content = file.read_text(encoding="utf-8")
        for before, after in texts.items():
            if before not in content:
                raise ValueError(f"{name} has no text {before!r}")
            content = content.replace(before, after)
        file.write_text(content, encoding="utf-8")
    path = os.pathsep.join(map(str, (folder / "server", ROOT / "tests", ROOT)))
    yield {**os.environ, "PYTHONPATH": path, "PYTHONDONTWRITEBYTECODE": "1"}
    shutil.rmtree(folder)


def run(environment: dict[str, str], *arguments: str) -> str | None:
    """Run Python in an environment. Return the end of what it printed where it failed, None where it did not."""
    command = [sys.executable, *arguments]
    try:
        ended = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, timeout=LIMIT)
    except subprocess.TimeoutExpired:
        return f"not ended after {LIMIT:g} s"
    return (ended.stdout + ended.stderr)[-2000:] if ended.returncode else None
