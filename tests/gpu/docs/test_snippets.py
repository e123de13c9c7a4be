"""The snippets of README.md (smaller), docs/python.md and docs/sequences.md, with GL and against a real server."""

import json
import shlex
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from seafoam.cli import main
from seafoam.render.gl.executor import Executor
from support.command import UNPLANNED, served
from support.snippets import NOT_RUN, blocks, commands, smaller

ADDRESS = "http://127.0.0.1:8000"


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    cache = str(tmp_path_factory.mktemp("cache"))
    with served(code=UNPLANNED, SEAFOAM_CACHE=cache, SEAFOAM_DEADLINE="60") as address:
        yield address


@pytest.fixture
def seafoam(
    executor: Executor, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Callable[..., str]:
    """Runs the command in an empty folder and gives what it prints; it must end well."""
    monkeypatch.chdir(tmp_path)
    # One context for all: its programs are compiled once.
    monkeypatch.setattr("seafoam.render.gl.executor.Executor", lambda **_: executor)
    monkeypatch.setattr(executor, "close", lambda: None)

    def run(*arguments: str) -> str:
        with pytest.raises(SystemExit) as left:
            main(arguments)
        said = capsys.readouterr()
        assert left.value.code == 0, (arguments, said.err)
        return said.out

    return run


def test_readme(server: str, seafoam: Callable[..., str]) -> None:
    written: dict[str, int] = {}
    for command in commands("README.md"):
        if any(command.startswith(beginning) for beginning in NOT_RUN):
            continue
        program, *arguments = shlex.split(smaller(command).replace(ADDRESS, server))
        if program == "curl":
            subprocess.run(["curl", "-sSf", *arguments], check=True, capture_output=True)
        else:
            assert program == ".venv/bin/seafoam"
            seafoam(*arguments)
        if "-o" in arguments:
            file = arguments[arguments.index("-o") + 1]
            written[file] = Path(file).stat().st_size
    assert {Path(file).suffix for file in written} == {".png", ".exr", ".npy", ".u16"}
    assert min(written.values()) > 500


def test_python(server: str, tmp_path: Path) -> None:
    code = "\n".join(blocks("docs/python.md", "python")).replace(ADDRESS, server).replace("(640, 360)", "(64, 36)")
    checks = """
assert sea.size == (64, 36) and coverage > 0
assert thresholds.shape == (64, 64) and abs(foam.mean() - 0.3) < 1e-4
assert first != second and image.size == (96, 54) and array.shape == (54, 96, 4)
assert picture.size == (96, 54) and water.camera.yaw == 0.5
seafoam.close()
"""
    script = tmp_path / "script.py"
    script.write_text(code + checks, encoding="utf-8")
    done = subprocess.run([sys.executable, script], cwd=tmp_path, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    assert "camera/yaw" in done.stdout
    for name in ("sea.png", "own.png"):
        assert np.asarray(Image.open(tmp_path / name)).std() > 5


def test_sequences(server: str, tmp_path: Path, seafoam: Callable[..., str]) -> None:
    for line in "".join(blocks("docs/sequences.md", "sh")).replace(ADDRESS, server).splitlines():
        program, *arguments = shlex.split(line)
        if program == "seafoam":
            assert "5 frames of 128 × 72" in seafoam(*arguments)
        else:
            posted = subprocess.run([program, *arguments], capture_output=True, text=True, check=True)
            assert json.loads(posted.stdout)["frames"] == 5
    assert sorted(each.name for each in tmp_path.iterdir()) == ["frames", "sea.mp4", "sea.webp"]
    seafoam("render", "default", "--time", str(1 / 24), "--size", "128x72", "--quality", "fast", "-o", "one.png")
    assert (tmp_path / "one.png").read_bytes() == (tmp_path / "frames" / "frame-000001.png").read_bytes()
