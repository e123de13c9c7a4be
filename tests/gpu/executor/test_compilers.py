"""Programs that a second process compiles: shared out once each, and as this process would compile them."""

import os
import subprocess
import sys
import time
from collections.abc import Iterable
from pathlib import Path

import pytest

from seafoam.framegraph.visibility import drawn_passes
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render.gl import compilers
from seafoam.render.gl.compilers import CompileRequest, CompileWork, SecondCompiler
from seafoam.render.gl.executor import longest_first
from support.scenes import load_preset

PRESET = "pool-caustics"
"""Little to compile, and a texture with levels."""
DRAW = f"""
import hashlib, os, sys
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from seafoam.scene import load_preset
preset = load_preset("{PRESET}")
plan = make_plan(preset.scene, TIERS["fast"])
executor = Executor(assisted="assisted" in sys.argv, optimized="at once" not in sys.argv)
picture = executor.render(plan, time=preset.time, camera=preset.scene.camera, width=64, height=36, output="rgba8")
def children():
    return len(open(f"/proc/self/task/{{os.getpid()}}/children").read().split())
beside = children()
executor.close()
assert not children()
# Mesa's state does not survive a fork.
Executor(assisted=True)
assert not children()
print(hashlib.sha256(picture.pixels).hexdigest(), beside)
"""
COMPILE = """
from dataclasses import replace
from seafoam.render.gl.compilers import SecondCompiler
from seafoam.render.gl.executor import Executor
from gpu.executor.test_compilers import _request
request = _request()
second = SecondCompiler(lambda: Executor().compile_frame)
# It has all but the first.
second.ask(replace(request, passes=[request.passes[0], *request.passes]))
second.wait()
second.close()
"""


def _drawn(*arguments: str) -> list[str]:
    """Hash of a picture that a process of its own draws, and how many processes it has beside it."""
    done = subprocess.run([sys.executable, "-c", DRAW, *arguments], check=True, capture_output=True, text=True)
    return done.stdout.split()


def _request() -> CompileRequest:
    scene = load_preset(PRESET).scene
    plan = make_plan(scene, TIERS["fast"])
    drawn = drawn_passes(plan, scene.camera, 64, 36, "screen")
    passes = longest_first(plan, [index for index, visible in drawn.items() if visible])
    return CompileRequest(plan, passes, scene.camera, 64, 36, "rgba8")


def _nothing() -> CompileWork:
    return lambda request, passes: None


def _one() -> CompileWork:
    """Takes one pass."""
    return lambda request, passes: next(iter(passes), None)


def _all() -> CompileWork:
    return lambda request, passes: list(passes)


@pytest.mark.parametrize(("work", "left"), [(_nothing, 0), (_one, 1), (_all, None)])
def test_each_pass_is_compiled_once(work, left) -> None:
    """By the process that asks first; of the longest program's this one is sure."""
    request, second = _request(), SecondCompiler(work)
    for _ in range(2):
        own = second.ask(request)
        second.wait()
        taken = len(request.passes) - 1 if left is None else left
        assert [*own] == [request.passes[0], *request.passes[1 + taken :]]
    own = second.ask(request)
    second.withdraw()
    assert [*own] == request.passes[:1]
    second.close()


def test_a_second_process_that_hangs_or_dies_is_not_waited_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(compilers, "WAIT_SECONDS", 0.1)
    request = _request()

    def hangs() -> CompileWork:
        def work(asked: CompileRequest, passes: Iterable[int]) -> None:
            time.sleep(1000)

        return work

    second = SecondCompiler(hangs)
    for _ in range(2):
        # The second time it has been ended, and this process had an error before it had taken all.
        next(second.ask(request))
        second.wait()
    assert [*second.ask(request)] == request.passes
    second.close()
    with pytest.raises(ProcessLookupError):
        os.kill(second.process, 0)


def test_a_second_process_ends_with_the_first() -> None:
    """Also where that is killed; and it holds none of its pipes."""
    reads, writes = os.pipe()
    script = """
import os, signal
from seafoam.render.gl.compilers import SecondCompiler
second = SecondCompiler(lambda: print)
print(second.process, flush=True)
os.kill(os.getpid(), signal.SIGKILL)
"""
    first = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, pass_fds=[writes])
    os.close(writes)
    # These end when every process has closed them: the second one, too.
    assert os.read(reads, 1) == b""
    assert first.communicate(timeout=60)[0].strip().isdigit()
    os.close(reads)


def test_without_a_renderer_no_process_is_left() -> None:
    script = """
import os
from seafoam.render.gl.executor import Executor, NoRendererError
try:
    Executor(99, assisted=True)
except NoRendererError:
    print(open(f"/proc/self/task/{os.getpid()}/children").read().split())
"""
    done = subprocess.run([sys.executable, "-c", script], check=True, capture_output=True, text=True)
    assert done.stdout.strip() == "[]"


def test_the_second_process_leaves_nothing_to_compile(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What it compiled for other states than those of the frame would be compiled again."""
    monkeypatch.setenv("MESA_SHADER_CACHE_DIR", str(tmp_path))
    monkeypatch.setenv("MESA_DISK_CACHE_MULTI_FILE", "true")

    def size() -> int:
        return sum(each.stat().st_size for each in tmp_path.rglob("*") if each.is_file())

    subprocess.run([sys.executable, "-c", COMPILE], check=True, cwd=Path(__file__).parents[2])
    before, drawn = size(), _drawn()
    # Programs of the driver's own, by which it reads a picture back, have 3 KB each, the plan's up to 50.
    assert 0 < before <= size() < before + 16_000
    monkeypatch.setenv("MESA_SHADER_CACHE_DIR", str(tmp_path / "cold"))
    # Cold, and with what the driver has kept.
    assert [_drawn("assisted") for _ in range(2)] == [[drawn[0], "1"]] * 2
    assert drawn[1] == "0"


def test_code_that_is_not_optimized_draws_the_same(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """And other processes draw with the optimized code, which the driver keeps apart."""
    monkeypatch.setenv("MESA_SHADER_CACHE_DIR", str(tmp_path))
    monkeypatch.setenv("MESA_DISK_CACHE_MULTI_FILE", "true")

    def kept() -> int:
        return sum(each.is_file() for each in tmp_path.rglob("*"))

    pictures, counts = set(), []
    for way in ("optimized", "at once", "optimized", "at once"):
        pictures.add(_drawn(way)[0])
        counts.append(kept())
    assert len(pictures) == 1
    assert 0 < counts[0] < counts[1] == counts[2] == counts[3]
