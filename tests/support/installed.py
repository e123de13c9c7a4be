"""A wheel as people get it: in a virtual environment that has what the wheel declares, and nothing else.

The packages are those of the tests' own environment, by links, so that nothing is downloaded. What the tests have and
the wheel does not declare is missing there.
"""

import subprocess
import sys
import venv
from collections.abc import Iterator
from importlib.metadata import Distribution, distribution
from pathlib import Path

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name


def environment(folder: Path, wheel: Path, extra: str = "") -> Path:
    """Make an environment with the wheel and what it needs, also of an extra. Return its folder of programs."""
    venv.create(folder, with_pip=False)
    programs = folder / ("Scripts" if sys.platform == "win32" else "bin")
    pip = [sys.executable, "-m", "pip", "--python", programs / "python", "install", "-q", "--no-deps", "--no-index"]
    subprocess.run([*pip, wheel], check=True, capture_output=True)
    (site,) = folder.glob("lib/python*/site-packages")
    (own,) = Distribution.discover(name="seafoam", path=[str(site)])
    for needed in _needed(own, {extra}):
        for file in needed.files or ():
            if ".." not in file.parts:
                link = site / file
                link.parent.mkdir(parents=True, exist_ok=True)
                # Packages of one namespace may bring the same file.
                if not link.exists():
                    link.symlink_to(Path(str(needed.locate_file(file))))
    return programs


def _needed(own: Distribution, extras: set[str]) -> Iterator[Distribution]:
    """Yield the distributions that one needs with these extras, each once, and what they need in turn."""
    seen: set[tuple[str, str]] = set()
    waiting = [(own, extra) for extra in extras | {""}]
    while waiting:
        found, extra = waiting.pop()
        for text in found.requires or ():
            requirement = Requirement(text)
            if requirement.marker is not None and not requirement.marker.evaluate({"extra": extra}):
                continue
            needed = distribution(requirement.name)
            for each in requirement.extras | {""}:
                key = (canonicalize_name(requirement.name), each)
                if key not in seen:
                    seen.add(key)
                    waiting.append((needed, each))
                    if not each:
                        yield needed
