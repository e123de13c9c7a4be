"""Bounds of the surface, and the horizon."""

import hashlib
import math
from functools import cache
from itertools import cycle
from pathlib import Path

import numpy as np
import pytest

from seafoam.framegraph.resources import FixedSize, Target
from seafoam.planner import FramePlan, make_plan
from seafoam.planner.glsl import read_file
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from support.exact import UNFILTERED
from support.pictures import draw
from support.probe import WHOLE
from support.report import Report
from support.scenes import Boat, Camera, Current, Scene, Stone, load_preset, preset_names
from support.sweep import crossed

SIDE = 192
QUALITIES = {"standard": TIERS["standard"], "exact": UNFILTERED}
TIMES = (0.0, 12.3, 1e6 + 3.5)
SPANS = (12.0, 150.0)
TABLE = "Bounds of the surface, and the most that is met at 10⁵ places and times"


def text_of(name: str) -> str:
    """A program of this folder."""
    return Path(__file__).with_name(name).read_text(encoding="utf-8")


def probing(plan: FramePlan, span: float) -> FramePlan:
    """The plan with its pass of starts drawing what breaks a bound instead: over, steeper, risen (m), bend (1/m)."""
    told = any("waves/sea.glsl@short" in effect.files for effect in plan.effects)
    few, fewest = ("sea_short", "short_bounds()") if told else ("vec3(0.0)", "vec3(0.0)")
    # What bounds of standing waves are told for is the ray's own way, not those to its sides.
    stand = any(effect.name == "standing waves" for effect in plan.effects)
    angle = "atan(p.y, p.x)" if stand else "0.785398 * float(i) + 0.1 * float(j)"
    measured = "stones_bounds" in plan.targets
    gentler = "stones_gentler(ray, 0.9)" if measured else "0.0"
    given = {"SIDE": float(SIDE), "SPAN": span, "FEW": few, "FEWEST": fewest, "ANGLE": angle, "GENTLER": gentler}
    defined = "".join(f"#define {name} ({value})\n" for name, value in given.items())
    # Its texture is declared already.
    of_stones = read_file("waves/standing.glsl@gentler").replace("uniform sampler2D", "// ") if measured else ""
    bounds = read_file("waves/sea.glsl@short_bounds") if told else ""
    return instead(plan, f"{bounds}{of_stones}{defined}{text_of('bounds.glsl')}")


def instead(plan: FramePlan, main: str) -> FramePlan:
    """The plan with its pass of starts drawing by another ``main`` into a target of SIDE x SIDE."""
    pass_ = next(one for one in plan.passes if one.target == "start")
    program = plan.programs[pass_.program]
    text = program.fragment.text
    text = text[: text.index("out vec4 o_start;")] + main
    fragment = program.fragment.model_copy(update={"text": text, "sha256": hashlib.sha256(text.encode()).hexdigest()})
    return plan.model_copy(
        update={
            "programs": plan.programs | {pass_.program: program.model_copy(update={"fragment": fragment})},
            "targets": plan.targets | {"start": Target(size=FixedSize(width=SIDE, height=SIDE), format="RGBA32F")},
            "linear": "start",
        }
    )


@cache
def scenes() -> dict[str, Scene]:
    """Every preset whose surface is drawn and not level, boats of other speeds than theirs, and stones."""
    found = {name: load_preset(name).scene.settled for name in preset_names()}
    for speed, radius in ((2.0, 20.0), (5.0, 30.0), (9.0, 80.0)):
        found[f"a boat at {speed:g} m/s"] = Scene(
            boats=(Boat(centre=(0.0, 0.0), radius=radius, speed=speed, wake=0.4),)
        )
    stones = (Stone(place=(5.0, 2.0), radius=0.4, waves=1.0), Stone(place=(-3.0, 1.0), radius=2.0, waves=1.0))
    found["stones in a current"] = Scene(current=Current(speed=2.5, direction=2.5, stones=stones))
    raised = ("waves", "sea", "rings", "boats", "current", "shore")
    return {name: scene for name, scene in found.items() if scene.light and any(getattr(scene, one) for one in raised)}


@pytest.mark.parametrize(("name", "quality"), crossed(sorted(scenes()), QUALITIES, len(QUALITIES), 4))
def test_no_wave_passes_its_bounds(name: str, quality: str, executor: Executor, report: Report) -> None:
    scene = scenes()[name]
    plan = make_plan(scene, QUALITIES[quality].model_copy(update={"samples": 1}))
    assert plan.top > 0.0
    worst = np.full(4, -np.inf)
    for span in (*SPANS, 1500.0) if scene.shore else SPANS:
        drawn = probing(plan, span)
        for time in TIMES:
            camera = scene.camera.model_copy(
                update={"position": (7.0, 5.0, -3.0) if scene.boats else scene.camera.position}
            )
            pixels = draw(executor, drawn, camera, time=time, size=(64, 36), output="linear")
            worst = np.maximum(worst, pixels.reshape(-1, 4).max(axis=0))
    over, steeper, risen, bend = worst
    grain = plan.uniforms["u_surface_grain"].rules[0].value[0]
    report.add(
        TABLE,
        scene=f"{name}, {quality}",
        over=f"{over:.3g} m",
        steeper=f"{steeper:.3g}",
        risen=f"{risen:.2g} m",
        grain=f"{grain:.2g} m",
        bend=f"{bend:.3g} /m",
    )
    assert over <= 1e-3
    assert steeper <= 1e-3
    assert risen <= grain + 1e-3


@pytest.mark.parametrize("texels", [64, 128, 512])
@pytest.mark.parametrize("name", ["coastline", "lagoon", "spray-on-rocks"])
def test_what_the_tree_calls_free_has_no_land(name: str, texels: int, executor: Executor) -> None:
    quality = TIERS["standard"].model_copy(update={"samples": 1, "shore_floor": texels})
    scene = load_preset(name).scene
    drawn = instead(make_plan(scene, quality), text_of("land.glsl"))
    pixels = draw(executor, drawn, scene.camera, time=0.0, size=(64, 36), output="linear")
    inside, met, far, _ = pixels.reshape(-1, 4).T
    assert inside.max() <= 1e-3
    # Some beams meet land after a way, others none.
    assert 0.05 < met.mean() < 0.95
    assert far.mean() > 0.05


SIZES = ((48, 27), (64, 7), (5, 61), (1, 1))
"""Of which each camera draws one, and those of each height all."""


def over_the_target(plan: FramePlan) -> FramePlan:
    """The plan with every pass that keeps under the horizon drawn over the whole target."""
    programs = dict(plan.programs)
    for name, program in programs.items():
        if any(file.path == "vertex/vertex.glsl@falling" for file in program.vertex.files):
            programs[name] = program.model_copy(update={"vertex": WHOLE})
    assert programs != plan.programs
    return plan.model_copy(update={"programs": programs})


def cameras(top: float) -> list[Camera]:
    """High and low, among crests and over all of them, every way up; straight down and up."""
    chance = np.random.default_rng(23)
    found = [Camera(position=(3.0, top + 2.0, 1.0), pitch=sign * math.pi / 2, roll=1.0) for sign in (-1.0, 1.0)]
    for height in (0.3 * top, top, top + 0.01, top + 1.0, top + 40.0):
        for _ in range(4):
            yaw, roll = chance.uniform(-math.pi, math.pi, 2)
            pitch, fov = chance.uniform(-1.2, 0.9), chance.uniform(0.2, 2.4)
            found.append(Camera(position=(5.0, height, -2.0), yaw=yaw, pitch=pitch, roll=roll, fov=fov))
    return found


@pytest.mark.parametrize("preset", ["default", "beach"])
def test_no_pixel_is_different(executor: Executor, preset: str) -> None:
    scene: Scene = load_preset(preset).scene
    plan = make_plan(scene, TIERS["standard"])
    whole = over_the_target(plan)
    water = 0
    for camera, size in zip(cameras(plan.top), cycle(SIZES)):
        one, other = (draw(executor, each, camera, time=2.7, size=size, output="linear") for each in (plan, whole))
        assert (one == other).all(), (camera, size)
        water += int((one[..., 3] > 0.0).sum())
    assert water > 0
