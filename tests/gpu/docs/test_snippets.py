"""The snippets of README.md (smaller), docs/python.md and docs/sequences.md, with GL and against a real server."""

import json
import shlex
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from seafoam.cli import main
from seafoam.render.gl.executor import Executor
from support.command import run, served
from support.snippets import NOT_RUN, blocks, commands

ADDRESS = "http://127.0.0.1:8000"


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    with served(SEAFOAM_CACHE=str(tmp_path_factory.mktemp("cache")), SEAFOAM_DEADLINE="60") as address:
        yield address


SMALLER = {
    "1280x720": "96x54",
    "width=1280&height=720": "width=96&height=54&quality=fast",
    "--size 256": "--size 64",
    "size=256": "size=64",
    "render default -o": "render default --size 96x54 -o",
    "render default": "render default --quality fast",
}


def test_readme(server: str, executor: Executor, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    # One context for all: its programs are compiled once.
    monkeypatch.setattr("seafoam.render.gl.executor.Executor", lambda **_: executor)
    monkeypatch.setattr(executor, "close", lambda: None)
    written: dict[str, int] = {}
    for command in commands("README.md"):
        if any(command.startswith(beginning) for beginning in NOT_RUN):
            continue
        for large, small in SMALLER.items():
            command = command.replace(large, small)
        program, *arguments = shlex.split(command.replace(ADDRESS, server))
        if program == "curl":
            subprocess.run(["curl", "-sSf", *arguments], check=True, capture_output=True)
        else:
            assert program == ".venv/bin/seafoam"
            with pytest.raises(SystemExit) as left:
                main(arguments)
            assert left.value.code == 0, command
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


def test_sequences(server: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for line in "".join(blocks("docs/sequences.md", "sh")).replace(ADDRESS, server).splitlines():
        program, *arguments = shlex.split(line)
        if program == "seafoam":
            done = run(*arguments)
            assert done.returncode == 0, done.stderr
            assert "5 frames of 128 × 72" in done.stdout
        else:
            posted = subprocess.run([program, *arguments], capture_output=True, text=True, check=True)
            assert json.loads(posted.stdout)["frames"] == 5
    assert sorted(each.name for each in tmp_path.iterdir()) == ["frames", "sea.mp4", "sea.webp"]
    command = ["default", "--time", str(1 / 24), "--size", "128x72", "--quality", "fast", "-o", "one.png"]
    assert run("render", *command).returncode == 0
    assert (tmp_path / "one.png").read_bytes() == (tmp_path / "frames" / "frame-000001.png").read_bytes()
