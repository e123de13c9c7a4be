"""The wheel carries shaders, masks and the built web client; what the documents say works where there is nothing else.

Its environments are outside the repository, with the packages that it declares: without extras, and with each alone.

Those packages are the tests' own, by links, so that nothing is downloaded. What the tests have and the wheel does not
declare is missing there.
"""

import json
import os
import shlex
import subprocess
import sys
import tomllib
import venv
import zipfile
from collections.abc import Iterator
from importlib.metadata import Distribution, distribution
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from seafoam.planner import make_plan
from seafoam.quality import TIERS
from support.scenes import load_preset, preset_names
from support.snippets import blocks, commands, smaller
from support.sweep import spread

ROOT = Path(__file__).parents[3]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


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


EXTRAS = {
    "sequence default --start": "video",
    "masks spectrum": "reports",
    "accuracy": "reports",
    "render default --quality auto": "reports",
    "sequence default --workers": "cluster",
    "serve": "telemetry",
    "openapi": "telemetry",
}
"""Beginnings of commands -> the extra that they need."""
REFUSED = (
    "render default --quality auto --budget-ms 9 -o a.png",
    "sequence default --workers 2 --stop 2.1 --start 2 --size 64x36 -o frames",
    "serve --port 0",
    "openapi",
)
"""And those that are not in README."""
COLLECTOR = {"OTEL_EXPORTER_OTLP_ENDPOINT": "http://127.0.0.1:9"}
LINES = """
import contextlib, io, json, sys
from typer.main import get_command
import seafoam
from seafoam.cli import app, main
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.resources import data_dir
from seafoam.scene import load_preset

def run(words):
    errors = io.StringIO()
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(errors):
        try:
            main(words)
        except SystemExit as left:
            return left.code, errors.getvalue()

def walk(command, *names):
    yield names
    for name, below in getattr(command, "commands", {}).items():
        yield from walk(below, *names, name)

asked = json.load(sys.stdin)
told = {
    "files": [seafoam.__file__, *map(str, map(data_dir, ("shaders", "masks", "webclient")))],
    "plans": [make_plan(load_preset(name).scene, TIERS["fast"]).sha256 for name in asked["presets"]],
    "said": [run(words) for words in asked["commands"]],
    "helps": {" ".join(names): run([*names, "--help"]) for names in walk(get_command(app))},
}
print(json.dumps(told))
"""
"""All that runs in one process of an environment: to start one, and to import, takes longer than most commands."""


@pytest.fixture(scope="module")
def bare(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return environment(tmp_path_factory.mktemp("bare") / "venv", wheel)


def test_the_metadata_names_the_pythons_that_are_tested() -> None:
    prefix = "Programming Language :: Python :: 3."
    minors = sorted(int(each.removeprefix(prefix)) for each in PROJECT["classifiers"] if each.startswith(prefix))
    assert PROJECT["requires-python"] == f">=3.{minors[0]}"
    assert minors == list(range(minors[0], minors[-1] + 1))
    assert (3, minors[0]) <= sys.version_info[:2] <= (3, minors[-1])


def run(command: Path, *arguments: str | Path, within: Path, given: str | None = None) -> str:
    """What a command writes, which ends well, in a folder, with an exporter of traces where that is installed."""
    variables = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")} | COLLECTOR
    done = subprocess.run(
        [command, *arguments], cwd=within, env=variables, input=given, capture_output=True, text=True, timeout=240
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_commands_without_extras(bare: Path, tmp_path: Path) -> None:
    """What README says works, or says in one line which extra it needs; plans are those of the tests."""
    readme = [smaller(command).removeprefix(".venv/bin/seafoam ") for command in commands("README.md")]
    asked = [each for each in readme if each.startswith(("render", "sequence", "plan", "masks", "accuracy"))]
    assert asked[0].startswith("render default")
    asked += REFUSED
    presets = preset_names()[::4]
    given = json.dumps({"commands": [shlex.split(each) for each in asked], "presets": presets})
    told = json.loads(run(bare / "python", "-c", LINES, within=tmp_path, given=given))
    assert all(Path(file).is_relative_to(bare.parent) for file in told["files"])
    assert told["plans"] == [make_plan(load_preset(name).scene, TIERS["fast"]).sha256 for name in presets]
    for command, (code, said) in zip(asked, told["said"], strict=True):
        extra = next((extra for start, extra in EXTRAS.items() if command.startswith(start)), None)
        assert code == (0 if extra is None else 1), f"{command}: {said}"
        if extra is not None:
            assert (said.count("\n"), f"pip install 'seafoam[{extra}]'" in said) == (1, True), f"{command}: {said}"
    assert {"", "render", "masks spectrum"} <= told["helps"].keys()
    assert [names for names, (code, _) in told["helps"].items() if code] == []
    assert (tmp_path / "sea.png").read_bytes().startswith(b"\x89PNG")


def test_python_without_extras(bare: Path, tmp_path: Path) -> None:
    """With extras, and in the tests' own Python: tests/gpu/docs/test_snippets.py."""
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
    assert run(bare / "python", "-W", "error", "-c", code, within=tmp_path).splitlines()[-1] == "True"


ALONE = {
    "video": "sequence default --start 2 --stop 2.1 --size 64x36 --quality fast -o sea.mp4",
    "telemetry": "openapi",
    "reports": "masks spectrum vac-24 -o spectrum.png",
    "cluster": "sequence default --stop 2.05 --start 2 --size 64x36 --quality fast --workers 2 -o frames",
    "notebook": "",
}
"""Extras -> a command that needs it."""


@pytest.mark.parametrize("extra", spread(ALONE, len(ALONE)))
def test_an_extra_alone_is_enough(wheel: Path, tmp_path: Path, extra: str) -> None:
    programs = environment(tmp_path / "venv", wheel, extra)
    if extra == "notebook":
        run(programs / "python", "-c", "from seafoam import *; Water('default')", within=tmp_path)
    else:
        run(programs / "seafoam", *ALONE[extra].split(), within=tmp_path)
