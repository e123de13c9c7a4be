"""Starts: the commands, and the first frame of every preset in a process of its own.

The driver's cache of programs is empty, and then as the first run left it.
"""

import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path
from statistics import median

from bench.report import Column, Table, ms
from bench.watch import Watch

ROUNDS = 3
"""Of each command; its table has the medians."""
COMMAND = ("-c", "from seafoam.cli import main; main()")
FRAME = """
import json, sys, time
began = time.perf_counter()
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from seafoam.scene import load_preset
preset = load_preset(sys.argv[1])
imported = time.perf_counter()
plan = make_plan(preset.scene, TIERS["standard"])
planned = time.perf_counter()
executor = Executor(assisted="assisted" in sys.argv, optimized="at-once" not in sys.argv)
opened = time.perf_counter()
executor.render(plan, time=preset.time, camera=preset.scene.camera, width=64, height=36, output="rgba8")
print(json.dumps([imported - began, planned - imported, opened - planned, time.perf_counter() - opened]))
"""


def _run(folder: str, *arguments: str) -> tuple[float, str]:
    """Seconds that a Python process takes whose caches are in a folder, and what it prints.

    Modules are compiled, as an installation leaves them.
    """
    environment = {**os.environ, "SEAFOAM_CACHE": folder, "MESA_SHADER_CACHE_DIR": f"{folder}/mesa"}
    environment.pop("PYTHONDONTWRITEBYTECODE", None)
    began = time.perf_counter()
    done = subprocess.run([sys.executable, *arguments], env=environment, check=True, capture_output=True, text=True)
    return time.perf_counter() - began, done.stdout


def _first(folder: str, *arguments: str) -> list[float]:
    """The times that FRAME prints."""
    times: list[float] = json.loads(_run(folder, "-c", FRAME, *arguments)[1])
    return times


def _commands(watch: Watch) -> Table:
    """What a user waits for at a prompt."""
    rows: list[tuple[str, float, float]] = []
    with watch.step("start of commands"), tempfile.TemporaryDirectory() as made:
        picture = (*COMMAND, "render", "default", "--size", "64x36", "--output", str(Path(made, "one.png")))
        for words, arguments in {
            "import seafoam": ("-c", "import seafoam"),
            "seafoam --help": (*COMMAND, "--help"),
            "seafoam render default --size 64x36": picture,
        }.items():
            cold, again = [], []
            for index in range(ROUNDS):
                folder = str(Path(made, f"{len(rows)}-{index}"))
                cold.append(_run(folder, *arguments)[0])
                again.append(_run(folder, *arguments)[0])
            rows.append((words, median(cold), median(again)))
    return Table(
        "Start of commands",
        f"A process from its start to its end, ms; medians of {ROUNDS}.",
        (Column("command", "command"), Column("cold", "cold", ms), Column("again", "again", ms)),
        rows,
    )


def measure(presets: Sequence[str], watch: Watch) -> list[Table]:
    """Start every command and every preset, cold and again."""
    rows: list[tuple[object, ...]] = []
    for name in presets:
        with watch.step(f"{name}, start"), tempfile.TemporaryDirectory() as folder:
            *before, quick = _first(f"{folder}/quick", name, "assisted", "at-once")
            *_, again = _first(f"{folder}/quick", name, "assisted", "at-once")
            *_, alone = _first(f"{folder}/alone", name)
            *_, two = _first(f"{folder}/two", name, "assisted")
        rows.append((name, *before, alone, two, quick, again))
    return [
        _commands(watch),
        Table(
            "First frame of a preset",
            "In a process of its own, quality standard, 64 x 36, ms. Cold: the driver has kept no program. Alone: one "
            "process compiles; in two: two do, as for the package; at once: two, and nothing is optimized, as for so "
            "small a picture by seafoam render. Again: the same with what the driver has kept.",
            (
                Column("preset", "preset"),
                Column("imports", "imports", ms),
                Column("plan", "plan", ms),
                Column("context", "context", ms),
                Column("alone", "cold, alone", ms),
                Column("two", "cold, in two", ms),
                Column("quick", "cold, at once", ms),
                Column("again", "again", ms),
            ),
            rows,
        ),
    ]
