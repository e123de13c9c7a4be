"""Programs that a second process compiles: shared out once each, and as this process would compile them."""

import subprocess
import sys
from pathlib import Path

import pytest

from seafoam.framegraph.visibility import drawn_passes
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render.gl import executor as module
from seafoam.render.gl.compilers import Claims, CompileRequest, SecondCompiler
from seafoam.render.gl.executor import Executor, longest_first
from support.pictures import draw
from support.scenes import load_preset

PRESET = "pool-caustics"
"""Little to compile, and a texture with levels."""
DRAW = f"""
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from seafoam.scene.presets import load_preset
preset = load_preset("{PRESET}")
plan = make_plan(preset.scene, TIERS["fast"])
Executor().render(plan, time=preset.time, camera=preset.scene.camera, width=64, height=36, output="rgba8")
"""


def _request() -> CompileRequest:
    scene = load_preset(PRESET).scene
    plan = make_plan(scene, TIERS["fast"])
    passes = longest_first(plan, drawn_passes(plan, scene.camera, 64, 36, "screen"))
    return CompileRequest(plan, passes, scene.camera, 64, 36, "rgba8")


def test_each_pass_is_compiled_by_the_process_that_asks_first(executor: Executor, tmp_path: Path) -> None:
    request, claims = _request(), Claims(tmp_path)
    passes = request.passes
    assert list(claims.claimed(passes[::2])) == passes[::2]
    assert executor.compile_frame(request, claims) == len(passes[1::2])
    assert list(claims.claimed(passes)) == []


def test_the_second_process_leaves_nothing_to_compile(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What it compiled for other states than those of the frame would be compiled again."""
    monkeypatch.setenv("MESA_SHADER_CACHE_DIR", str(tmp_path))
    monkeypatch.setenv("MESA_DISK_CACHE_MULTI_FILE", "true")
    request = _request()

    def size() -> int:
        return sum(each.stat().st_size for each in tmp_path.rglob("*") if each.is_file())

    with SecondCompiler(request) as second:
        second._process.wait()
        assert {int(each.name) for each in second.claims.folder.iterdir() if each.is_dir()} == {*request.passes}
    before = size()
    subprocess.run([sys.executable, "-c", DRAW], check=True)
    # Programs of the driver's own, by which it reads a picture back, have 3 KB each, the plan's up to 50.
    assert 0 < before <= size() < before + 16_000


def test_an_assisted_frame_is_the_same_and_leaves_no_process(
    executor: Executor, monkeypatch: pytest.MonkeyPatch
) -> None:
    request, started = _request(), list[SecondCompiler]()

    def second(asked: CompileRequest) -> SecondCompiler:
        started.append(SecondCompiler(asked))
        return started[-1]

    def pixels() -> bytes:
        return draw(executor, request.plan, request.camera, time=1.0, size=(64, 36)).tobytes()

    alone = pixels()
    executor.forget()
    monkeypatch.setattr(executor, "_assisted", True)
    monkeypatch.setattr(module, "SecondCompiler", second)
    monkeypatch.setattr(module, "COLD_SECONDS", 0.0)
    assert pixels() == pixels() == alone
    assert len(started) == 1
    assert started[0]._process.returncode is not None
    assert not started[0].claims.folder.exists()
