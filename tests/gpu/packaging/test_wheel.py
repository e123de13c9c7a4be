"""The wheel carries shaders, masks and the built web client; what the documents say works where there is nothing else.

Its environments are outside the repository, with the packages that it declares: without extras, on the oldest and the
newest Python of this machine that the metadata admits, and with each extra alone.

Those packages are the tests' own, by links, so that nothing is downloaded for its Python. What the tests have and the
wheel does not declare is missing there.
"""

import os
import re
import shlex
import subprocess
import sys
import tomllib
import venv
import zipfile
from collections.abc import Iterator
from functools import cache
from importlib.metadata import Distribution, distribution
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.specifiers import SpecifierSet
from packaging.utils import canonicalize_name

from seafoam.planner import make_plan
from seafoam.quality import TIERS
from support.scenes import load_preset, preset_names
from support.snippets import blocks, commands
from support.sweep import spread

ROOT = Path(__file__).parents[3]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
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
    subprocess.run([python, "-m", "venv", "--without-pip", folder], check=True, capture_output=True)
    pins = [f"{each.name}=={each.version}" for each in _needed(distribution("seafoam"), set())]
    # What is imported is compiled then, a small part of the packages.
    pip = [sys.executable, "-m", "pip", "--python", folder / "bin" / "python", "install", "-q", "--no-compile"]
    pip += ["--only-binary", ":all:"]
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


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    directory = tmp_path_factory.mktemp("wheel")
    command = [sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", "--no-build-isolation", "-w", directory, ROOT]
    subprocess.run(command, check=True, capture_output=True)
    (built,) = directory.glob("seafoam-*.whl")
    return built


def test_the_wheel_carries_its_data(wheel: Path) -> None:
    names = set(zipfile.ZipFile(wheel).namelist())
    for folder, source, pattern in (
        ("shaders", ROOT / "shaders", "**/*.glsl"),
        ("masks", ROOT / "masks", "*.ranks"),
        ("masks", ROOT / "masks", "*.tables"),
        ("webclient", ROOT / "webclient" / "dist", "**/*.*"),
    ):
        wanted = {f"seafoam/_data/{folder}/{path.relative_to(source).as_posix()}" for path in source.glob(pattern)}
        assert wanted
        assert wanted <= names
    assert "seafoam/scene/presets/default.json" in names
    assert any(name.endswith("licenses/masks/LICENSE") for name in names)


SMALLER = {
    "1280x720": "64x36",
    "640x360": "64x36",
    "--stop 4": "--stop 0.1",
    "default -o": "default --size 64x36 -o",
    "--size 256": "--size 64",
}
"""Sizes of the documents -> those here."""
EXTRAS = {"sequence": "video", "masks spectrum": "reports", "accuracy": "reports"}
"""Beginnings of README's commands -> the extra that they need."""


@pytest.fixture(scope="module", params=["oldest", "newest"])
def bare(request: pytest.FixtureRequest, wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    found = interpreters()
    if request.param == "newest" and len(found) == 1:
        pytest.skip(f"of the Pythons that the metadata admits this machine has {OWN[0]}.{OWN[1]} alone")
    python = found[min(found) if request.param == "oldest" else max(found)]
    return environment(tmp_path_factory.mktemp("bare") / "venv", wheel, python=python)


newest = pytest.mark.parametrize("bare", ["newest"], indirect=True)
"""For what the tests' own Python does in other tests too."""
oldest = pytest.mark.parametrize("bare", ["oldest"], indirect=True)
"""For what does not depend on the Python."""


def test_the_metadata_names_the_pythons_that_are_tested() -> None:
    prefix = "Programming Language :: Python :: 3."
    minors = sorted(int(each.removeprefix(prefix)) for each in PROJECT["classifiers"] if each.startswith(prefix))
    assert PROJECT["requires-python"] == f">=3.{minors[0]}"
    assert minors == list(range(minors[0], minors[-1] + 1))
    assert (3, minors[0]) <= OWN <= (3, minors[-1])


def run(command: Path, *arguments: str | Path, within: Path, **variables: str) -> subprocess.CompletedProcess[str]:
    inherited = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    return subprocess.run(
        [command, *arguments], cwd=within, env=inherited | variables, capture_output=True, text=True, timeout=120
    )


def names_extra(done: subprocess.CompletedProcess[str], extra: str) -> bool:
    return done.returncode == 1 and done.stderr.count("\n") == 1 and f"pip install 'seafoam[{extra}]'" in done.stderr


@oldest
def test_data_is_that_of_the_wheel(bare: Path, tmp_path: Path) -> None:
    code = "import seafoam; from seafoam.resources import data_dir\n"
    code += "print(seafoam.__file__, *map(data_dir, ('shaders', 'masks', 'webclient')), sep='\\n')"
    done = run(bare / "python", "-c", code, within=tmp_path)
    assert done.returncode == 0, done.stderr
    assert all(Path(path).is_relative_to(bare.parent) for path in done.stdout.splitlines())


@newest
@pytest.mark.parametrize("share", spread(range(3), 3))
def test_plans_are_the_same_in_every_python(bare: Path, tmp_path: Path, share: int) -> None:
    """Of a third of the presets. In the tests' own: tests/fast/planner/test_plan.py."""
    code = f"""
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.scene.presets import load_preset, preset_names
for name in preset_names()[{share}::3]:
    print(name, make_plan(load_preset(name).scene, TIERS["fast"]).sha256)
"""
    done = run(bare / "python", "-c", code, within=tmp_path)
    assert done.returncode == 0, done.stderr
    here = {name: make_plan(load_preset(name).scene, TIERS["fast"]).sha256 for name in preset_names()[share::3]}
    assert dict(line.split() for line in done.stdout.splitlines()) == here


@newest
def test_commands_of_readme_without_extras(bare: Path, tmp_path: Path) -> None:
    found = [command.removeprefix(".venv/bin/seafoam ") for command in commands("README.md") if "/seafoam " in command]
    assert found[0].startswith("render default")
    for command in (each for each in found if not each.startswith("serve")):
        small = command
        for large, size in SMALLER.items():
            small = small.replace(large, size)
        done = run(bare / "seafoam", *shlex.split(small), within=tmp_path)
        extra = next((extra for start, extra in EXTRAS.items() if command.startswith(start)), None)
        if extra is None:
            assert done.returncode == 0, f"{command}: {done.stderr}"
        else:
            assert names_extra(done, extra), f"{command}: {done.stderr}"
    assert (tmp_path / "sea.png").read_bytes().startswith(b"\x89PNG")


@oldest
def test_every_command_has_help_without_extras(bare: Path, tmp_path: Path) -> None:
    code = """
from typer.main import get_command
from seafoam.cli import app, main

def walk(command, *names):
    yield names
    for name, below in getattr(command, "commands", {}).items():
        yield from walk(below, *names, name)

for names in walk(get_command(app)):
    try:
        main([*names, "--help"])
    except SystemExit as left:
        assert left.code == 0, names
        print("SHOWN", *names)
"""
    done = run(bare / "python", "-c", code, within=tmp_path)
    assert done.returncode == 0, done.stderr
    assert {"SHOWN", "SHOWN render", "SHOWN masks spectrum"} <= set(done.stdout.splitlines())


@oldest
@pytest.mark.whole
@pytest.mark.parametrize(
    ("extra", "arguments", "variables"),
    [
        ("reports", "render default --quality auto --budget-ms 9 -o a.png", {}),
        ("cluster", "sequence default --stop 2.1 --start 2 --size 64x36 --workers 2 -o frames", {}),
        ("telemetry", "serve --port 0", {"OTEL_EXPORTER_OTLP_ENDPOINT": "http://127.0.0.1:9"}),
        ("telemetry", "openapi", {"OTEL_EXPORTER_OTLP_ENDPOINT": "http://127.0.0.1:9"}),
    ],
)
def test_what_needs_an_extra_says_so(
    bare: Path, tmp_path: Path, extra: str, arguments: str, variables: dict[str, str]
) -> None:
    done = run(bare / "seafoam", *arguments.split(), within=tmp_path, **variables)
    assert names_extra(done, extra), done.stderr


def test_python_without_extras(bare: Path, tmp_path: Path) -> None:
    snippets = blocks("docs/python.md", "python")
    local = snippets[: next(i for i, snippet in enumerate(snippets) if "connect(" in snippet)]
    ends = """
import inspect, pydoc
assert inspect.signature(seafoam.frame).parameters.keys() == {
    "what", "time", "size", "quality", "camera", "look", "mask"
}
assert "ServerError" in pydoc.render_doc(seafoam)
exec("from seafoam import *")
seafoam.close()
try:
    seafoam.Water
except RuntimeError as error:
    print("seafoam[notebook]" in str(error))
"""
    code = "\n".join(local).replace("(640, 360)", "(64, 36)") + ends
    done = run(bare / "python", "-W", "error", "-c", code, within=tmp_path)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[-1] == "True"


@pytest.mark.parametrize(
    ("extra", "arguments"),
    [
        ("reports", "masks spectrum vac-24 -o spectrum.png"),
        ("video", "sequence default --start 2 --stop 2.1 --size 64x36 -o sea.mp4"),
        ("cluster", "sequence default --stop 2.05 --start 2 --size 64x36 --quality fast --workers 2 -o frames"),
        ("telemetry", "openapi"),
        ("notebook", ""),
    ],
)
def test_an_extra_alone_is_enough(wheel: Path, tmp_path: Path, extra: str, arguments: str) -> None:
    programs = environment(tmp_path / "venv", wheel, extra)
    if extra == "notebook":
        code = "from seafoam import *; Water('default')"
        done = run(programs / "python", "-c", code, within=tmp_path)
    else:
        collector = {"OTEL_EXPORTER_OTLP_ENDPOINT": "http://127.0.0.1:9"} if extra == "telemetry" else {}
        done = run(programs / "seafoam", *arguments.split(), within=tmp_path, **collector)
    assert done.returncode == 0, done.stderr
