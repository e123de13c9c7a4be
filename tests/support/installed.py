"""A wheel as people get it: in a virtual environment that has what the wheel declares, and nothing else.

The packages are those of the tests' own environment, by links, so that nothing is downloaded for its Python. What the
tests have and the wheel does not declare is missing there.
"""

import os
import re
import subprocess
import sys
import tomllib
import venv
from collections.abc import Iterator
from functools import cache
from importlib.metadata import Distribution, distribution
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.specifiers import SpecifierSet
from packaging.utils import canonicalize_name

PROJECT = tomllib.loads((Path(__file__).parents[2] / "pyproject.toml").read_text(encoding="utf-8"))["project"]
Version = tuple[int, int]
OWN: Version = sys.version_info[:2]
_TOOLS = ("~/.pyenv/versions", "~/.local/share/uv/python")
"""Where tools keep the interpreters that they install, beside the PATH."""


@cache
def interpreters() -> dict[Version, Path]:
    """Return the Pythons of this machine that the metadata admits, by version; that of the tests is its own."""
    folders = [Path(each) for each in os.get_exec_path()]
    folders += [found for tool in _TOOLS for found in Path(tool).expanduser().glob("*/bin")]
    admitted = SpecifierSet(PROJECT["requires-python"])
    found = {OWN: Path(sys.executable)}
    for path in (each for folder in folders for each in folder.glob("python3.*")):
        minor = re.fullmatch(r"python3\.(\d+)", path.name)
        version = (3, int(minor[1])) if minor else OWN
        if version not in found and admitted.contains("{}.{}".format(*version)) and _runs(path):
            found[version] = path
    return found


def _runs(python: Path) -> bool:
    """Whether it is an interpreter, and no stand-in for one that is not chosen."""
    return subprocess.run([python, "-c", "import venv"], capture_output=True).returncode == 0


def environment(folder: Path, wheel: Path, extra: str = "", python: Path = Path(sys.executable)) -> Path:
    """Make an environment with the wheel and what it needs, also of an extra. Return its folder of programs.

    python: another than that of the tests has the same versions of the packages, from the registry; where they are
    not to be had the test is skipped.
    """
    if python != Path(sys.executable):
        return _downloaded(folder, wheel, python)
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


def _downloaded(folder: Path, wheel: Path, python: Path) -> Path:
    subprocess.run([python, "-m", "venv", folder], check=True, capture_output=True)
    pins = [f"{each.name}=={each.version}" for each in _needed(distribution("seafoam"), set())]
    pip = [folder / "bin" / "python", "-m", "pip", "install", "-q", "--only-binary", ":all:"]
    done = subprocess.run([*pip, wheel, *pins], capture_output=True, text=True)
    if done.returncode:
        why = next((line for line in done.stderr.splitlines() if line.startswith("ERROR")), "pip failed")
        pytest.skip(f"{python.name}: the wheels of what the wheel needs cannot be installed: {why}")
    return folder / "bin"


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
