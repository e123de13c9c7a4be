"""The wheel carries shaders, masks and the built web client, and works where there is no repository."""

import json
import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]


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
        ("webclient", ROOT / "webclient" / "dist", "**/*.*"),
    ):
        wanted = {f"seafoam/_data/{folder}/{path.relative_to(source).as_posix()}" for path in source.glob(pattern)}
        assert wanted
        assert wanted <= names
    assert "seafoam/scene/presets/default.json" in names
    assert any(name.endswith("licenses/masks/LICENSE") for name in names)


def test_the_wheel_works_without_the_repository(wheel: Path, tmp_path: Path) -> None:
    target = tmp_path / "site"
    install = [sys.executable, "-m", "pip", "install", "-q", "--no-deps", "--target", target, wheel]
    subprocess.run(install, check=True, capture_output=True)
    script = tmp_path / "script.py"
    script.write_text(
        "import json, seafoam\n"
        "from seafoam.resources import data_dir\n"
        "print(json.dumps([seafoam.__file__, *(str(data_dir(k)) for k in ('shaders', 'masks', 'webclient'))]))\n"
    )
    environment = {**os.environ, "PYTHONPATH": str(target)}
    found = subprocess.run(
        [sys.executable, script], cwd=tmp_path, env=environment, check=True, capture_output=True, text=True
    )
    assert all(Path(path).is_relative_to(target) for path in json.loads(found.stdout))
    render = [sys.executable, "-c", "from seafoam.cli import main; main()", "render", "default"]
    subprocess.run(
        [*render, "--time", "9", "--size", "64x36", "-o", "frame.png"], cwd=tmp_path, env=environment, check=True
    )
    assert (tmp_path / "frame.png").read_bytes().startswith(b"\x89PNG")
