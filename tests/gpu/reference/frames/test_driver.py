"""The tests have llvmpipe compile without optimisations: what it draws must not hang on that."""

import hashlib
import os
import subprocess
import sys
from pathlib import Path

import pytest

from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
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
