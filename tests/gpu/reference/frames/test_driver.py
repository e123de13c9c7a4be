"""The tests have llvmpipe compile without optimisations: what it draws must not hang on that."""

import hashlib
import os
import subprocess
import sys
from pathlib import Path

import pytest

from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from seafoam.render.service.worker import CANARY_SIDE
from support.pictures import linear
from support.scenes import load_preset
from support.sweep import REST

DRAW = """
import sys
sys.path[:0] = sys.argv[2:]
import test_driver
from seafoam.render.gl.executor import Executor
executor = Executor()
print(test_driver.drawn(executor, sys.argv[1]))
"""

KEEP = """
import os, sys, time
from pathlib import Path
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from seafoam.scene import load_preset
executor, preset = Executor(), load_preset(sys.argv[1])
plan = make_plan(preset.scene, TIERS["fast"])
for size in sys.argv[2:]:
    width, height = map(int, size.split("x"))
    executor.render(plan, time=preset.time, camera=preset.scene.camera, width=width, height=height)
    # Mesa writes in a thread of its own.
    found, last = -1, -2
    while found != last:
        time.sleep(1.0)
        last, found = found, sum(f.stat().st_size for f in Path(os.environ["MESA_SHADER_CACHE_DIR"]).rglob("*"))
    print(found)
"""


def drawn(executor: Executor, preset: str) -> str:
    """Hash of a small picture's floats."""
    found = load_preset(preset)
    picture = linear(executor, found.scene, TIERS["standard"], time=found.time, size=(64, 36))
    return hashlib.sha256(picture.tobytes()).hexdigest()


@pytest.mark.parametrize("preset", [pytest.param(name, marks=REST) for name in ("default", "storm")] + ["lagoon"])
def test_optimised_programs_draw_the_same_bytes(preset: str, executor: Executor) -> None:
    assert os.environ["GALLIVM_PERF"] == "nopt"
    plain = {name: value for name, value in os.environ.items() if name != "GALLIVM_PERF"}
    here = Path(__file__).parent
    command = [sys.executable, "-c", DRAW, preset, str(here), str(here.parents[2])]
    told = subprocess.run(command, env=plain, capture_output=True, text=True, check=True, timeout=300)
    assert told.stdout.strip() == drawn(executor, preset)


def test_pictures_of_other_sizes_need_no_other_programs(tmp_path: Path) -> None:
    """The first picture of a worker is small: what is compiled for it must serve all others."""
    sizes = (f"{CANARY_SIDE}x{CANARY_SIDE}", "320x180", "512x288", "576x324", "384x216")
    environment = {**os.environ, "MESA_SHADER_CACHE_DIR": str(tmp_path)}
    command = [sys.executable, "-c", KEEP, "boat-race", *sizes]
    told = subprocess.run(command, env=environment, capture_output=True, text=True, check=True, timeout=300)
    first, *others = map(int, told.stdout.split())
    assert first > 100_000
    assert max(others) < 1.05 * first
