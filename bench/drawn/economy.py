"""Economy: a plan's own program against one that holds every effect, and against programs written by hand."""

import hashlib
import re
import time as clock
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np

from bench.drawn.frames import Cost, cost, ratios, side_by_side
from bench.drawn.uber import held_effects, slot_files, uber_plan
from bench.report import Column, Table, count, extra, ms, ratio_columns, times
from bench.watch import Watch
from seafoam.effects import EFFECTS
from seafoam.framegraph.plan import FramePlan, Shader
from seafoam.framegraph.rules import COMPONENTS, Constant
from seafoam.planner import make_plan
from seafoam.render.gl.executor import Executor
from seafoam.scene import Camera, Scene, load_preset, preset_names
from support.cases import cases_of
from support.exact import SQUARE, whole_plan

QUALITY = SQUARE
"""The program with every effect draws each pixel."""
SIZE = (640, 360)
HAND_SIZE = (1280, 720)
COMPILE_SIZE = (16, 16)
PICTURE_TIMES = (3.0, 40.7)
HALF_A_LEVEL = 0.5 / 255.0
FLIPPED = 2e-4
"""Maximum share of pixels that may differ: different rounding moves a few to the other side of a threshold."""

Row = tuple[Any, ...]

_DECLARED = re.compile(r"^uniform (?P<type>\w+) (?P<name>\w+)(?P<size>\[\w+\])?;", re.MULTILINE)


@dataclass(frozen=True)
class Difference:
    """Difference of two pictures in linear light, display white = 1: the greatest, and the share of pixels above half a
    level."""

    worst: float
    share: float


@dataclass(frozen=True)
class ByHand:
    """A scene, and a fragment program written only for it."""

    name: str
    title: str
    scene: Scene
    file: str


def by_hand() -> tuple[ByHand, ...]:
    """The scenes that have a program written by hand."""
    wake = load_preset("paper-wake").scene
    assert wake.foam is not None
    wave = wake.model_copy(
        update={
            "foam": wake.foam.model_copy(update={"look": "halftone"}),
            "water": wake.water.model_copy(update={"ripples": None}),
        }
    )
    return (
        ByHand("threshold", "preset paper-threshold", load_preset("paper-threshold").scene, "threshold.glsl"),
        ByHand("level", "the scene with nothing set: level water, sun, sky", Scene(), "level.glsl"),
        ByHand("wave", "preset paper-wake without ripples, halftone", wave, "wave.glsl"),
    )


def measure(executor: Executor, watch: Watch) -> list[Table]:
    """Check that the programs draw the same, then time them side by side."""
    return [*_presets(executor, watch), _bounds(executor, watch), *_hand(executor, watch)]


def _presets(executor: Executor, watch: Watch) -> list[Table]:
    drawn, programs, left_out = [], [], []
    for name in preset_names():
        scene = load_preset(name).scene
        plan = make_plan(scene, QUALITY)
        running = {note.name for note in plan.effects}
        skipped = {note.name for note in plan.skipped}
        absent = [effect.name for effect in EFFECTS if effect.name not in running | skipped]
        left_out.append((name, ", ".join(absent) or "nothing", ", ".join(sorted(skipped)) or "nothing"))
        if not running <= held_effects(QUALITY):
            continue
        plans = {
            "plan": plan,
            "uber": uber_plan(scene, QUALITY),
            "uber without sums": uber_plan(scene, QUALITY, exact_ripples=False),
        }
        drawn.append((name, *_preset_frames(executor, watch, name, plans, scene.camera)))
        programs.append((name, *_preset_programs(executor, watch, name, plans, scene.camera)))
    return [_frames_table(drawn), _programs_table(programs), _left_out_table(left_out)]


def _preset_frames(executor: Executor, watch: Watch, name: str, plans: Mapping[str, FramePlan], camera: Camera) -> Row:
    differences = [same_picture(executor, plan, plans["plan"], camera) for plan in plans.values()]
    costs = side_by_side(executor, plans, camera, SIZE, watch.rounds(f"{name}, all effects", 25, 10.0))
    return (
        *ratios(costs["uber"], costs["plan"]),
        *ratios(costs["uber without sums"], costs["plan"]),
        median(frame.cpu for frame in costs["plan"]),
        median(frame.cpu for frame in costs["uber"]),
        255.0 * max(difference.worst for difference in differences),
        len(costs["plan"]),
    )


def _preset_programs(
    executor: Executor, watch: Watch, name: str, plans: Mapping[str, FramePlan], camera: Camera
) -> Row:
    compiled = _compiled(executor, plans, camera, watch.rounds(f"{name}, compiling", 3, 6.0))
    plan, paths = plans["plan"], slot_files(QUALITY)
    return (
        f"{len(plan.effects)} of {len(EFFECTS)}",
        f"{len({file.path for file in _surface(plan).files} & set(paths))} of {len(paths)}",
        _size(plan),
        _size(plans["uber"]),
        *(median(program.cpu for program in compiled[which]) for which in ("plan", "uber")),
        ratios(compiled["uber"], compiled["plan"])[0],
    )


def _frames_table(rows: list[Row]) -> Table:
    return Table(
        "One program with every effect of the paper, against the plan's own",
        f"Whole frames of {SIZE[0]} x {SIZE[1]}, quality standard; medians of per-round ratios (interquartile range). "
        "Without sums: a program that lacks the ripples of the better tiers. Difference: the greatest of any pixel, "
        "levels of 255.",
        (
            Column("preset", "preset"),
            *ratio_columns(times),
            Column("cpu_ratio_without_sums", "without sums, processor", times),
            Column("wall_ratio_without_sums", "wall", times),
            Column("cpu", "the plan's, ms", ms),
            Column("uber_cpu", "all effects, ms", ms),
            Column("difference", "difference", _levels),
            Column("rounds", "rounds", count),
        ),
        rows,
    )


def _programs_table(rows: list[Row]) -> Table:
    return Table(
        "Programs",
        "The surface's fragment program. Compiled: from the text to the first pixels of a program that the driver "
        "has not seen, processor time.",
        (
            Column("preset", "preset"),
            Column("effects", "effects"),
            Column("files", "slot files"),
            Column("bytes", "bytes", count),
            Column("uber_bytes", "all effects", count),
            Column("compiled", "compiled, ms", ms),
            Column("uber_compiled", "all effects, ms", ms),
            Column("compile_ratio", "ratio", times),
        ),
        rows,
    )


def _left_out_table(rows: list[Row]) -> Table:
    return Table(
        "What the plans leave out",
        "Effects that the scene does not call for, and those that it calls for and that cannot be seen.",
        (Column("preset", "preset"), Column("absent", "not called for"), Column("skipped", "not seen")),
        rows,
    )


def _bounds(executor: Executor, watch: Watch) -> Table:
    rows = []
    for effect in EFFECTS:
        for scene in cases_of(effect).invisible[:1]:
            plans = {"plan": make_plan(scene, QUALITY), "full": whole_plan(scene, QUALITY)}
            notes = plans["plan"].skipped
            rounds = watch.rounds(f"without {effect.name}", 40, 4.0)
            costs = side_by_side(executor, plans, scene.camera, SIZE, rounds)
            rows.append(
                (
                    effect.name,
                    next(note.why for note in notes if note.name == effect.name),
                    ", ".join(note.name for note in notes if note.name != effect.name),
                    *ratios(costs["full"], costs["plan"]),
                    _size(plans["full"]) - _size(plans["plan"]),
                    len(costs["plan"]),
                )
            )
    return Table(
        "What cannot be seen",
        "For each effect the first scene that calls for it and cannot show it: with all that is left out, against "
        f"without it. {SIZE[0]} x {SIZE[1]}, quality standard.",
        (
            Column("effect", "effect"),
            Column("why", "why it is left out"),
            Column("others", "left out with it"),
            *ratio_columns(extra),
            Column("bytes", "bytes", count),
            Column("rounds", "rounds", count),
        ),
        rows,
    )


def _hand(executor: Executor, watch: Watch) -> list[Table]:
    drawn, programs = [], []
    for case in by_hand():
        plan = make_plan(case.scene, QUALITY)
        text = (Path(__file__).parents[1] / "minimal" / case.file).read_text(encoding="utf-8")
        plans = {"plan": plan, "hand": with_surface(plan, text)}
        plans |= {f"{name}, numbers": _with_numbers(variant) for name, variant in plans.items()}
        programs += _hand_programs(executor, watch, case, plans)
        drawn += _hand_frames(executor, watch, case, plans)
    return [_hand_frames_table(drawn), _hand_programs_table(programs)]


def _hand_programs(executor: Executor, watch: Watch, case: ByHand, plans: Mapping[str, FramePlan]) -> list[Row]:
    camera = case.scene.camera
    differences = {name: same_picture(executor, plans["plan"], variant, camera) for name, variant in plans.items()}
    compiled = _compiled(executor, plans, camera, watch.rounds(f"{case.name}, compiling", 5, 6.0))
    return [
        (
            case.name,
            name,
            _size(variant),
            median(program.cpu for program in compiled[name]),
            255.0 * differences[name].worst,
            differences[name].share,
        )
        for name, variant in plans.items()
    ]


def _hand_frames(executor: Executor, watch: Watch, case: ByHand, plans: Mapping[str, FramePlan]) -> list[Row]:
    whole = {name: plans[name] for name in ("plan", "hand")}
    surfaces = {f"{name}, alone": _alone(variant) for name, variant in plans.items()}
    rounds = watch.rounds(f"{case.name}, by hand", 60, 20.0)
    costs = side_by_side(executor, whole | surfaces, case.scene.camera, HAND_SIZE, rounds)
    rows = []
    for first, second in (("plan", "hand"), ("plan, numbers", "hand, numbers"), ("plan", "plan, numbers")):
        first_alone, second_alone = costs[f"{first}, alone"], costs[f"{second}, alone"]
        rows.append(
            (
                case.name,
                f"{first} : {second}",
                ratios(costs[first], costs[second])[0] if {first, second} <= whole.keys() else None,
                *ratios(first_alone, second_alone),
                median(frame.cpu for frame in first_alone),
                median(frame.cpu for frame in second_alone),
                len(first_alone),
            )
        )
    return rows


def _hand_frames_table(rows: list[Row]) -> Table:
    titles = "; ".join(f"{case.name}: {case.title}" for case in by_hand())
    return Table(
        "Against programs written by hand",
        f"{titles}. {HAND_SIZE[0]} x {HAND_SIZE[1]}, quality standard. Numbers: with all that does not change from "
        "frame to frame written into the text. Surface: its pass alone.",
        (
            Column("scene", "scene"),
            Column("compared", "compared"),
            Column("frame_cpu_ratio", "frame, processor", extra),
            Column("cpu_ratio", "surface, processor", extra),
            Column("wall_ratio", "surface, wall", extra),
            Column("cpu", "first, ms", ms),
            Column("other_cpu", "second, ms", ms),
            Column("rounds", "rounds", count),
        ),
        rows,
    )


def _hand_programs_table(rows: list[Row]) -> Table:
    return Table(
        "Programs written by hand",
        "Compiled as above. Difference from the plan's picture: the greatest, levels of 255, and the share of "
        "pixels that differ by half a level.",
        (
            Column("scene", "scene"),
            Column("program", "program"),
            Column("bytes", "bytes", count),
            Column("compiled", "compiled, ms", ms),
            Column("difference", "difference", _levels),
            Column("share", "pixels", lambda share: f"{100.0 * share:.4f} %"),
        ),
        rows,
    )


def _levels(value: float) -> str:
    return f"{value:.2f}"


def _surface(plan: FramePlan) -> Shader:
    return plan.programs["surface"].fragment


def _size(plan: FramePlan) -> int:
    """Bytes of the surface's fragment program."""
    return len(_surface(plan).text.encode())


def with_surface(plan: FramePlan, text: str) -> FramePlan:
    """The plan with another fragment shader for the surface."""
    shader = Shader(text=text, sha256=hashlib.sha256(text.encode()).hexdigest(), files=())
    program = plan.programs["surface"].model_copy(update={"fragment": shader})
    return plan.model_copy(update={"programs": {**plan.programs, "surface": program}})


def _with_numbers(plan: FramePlan) -> FramePlan:
    """The plan with those uniforms of its surface as constants that are the same in every frame."""

    def constant(declared: re.Match[str]) -> str:
        uniform = plan.uniforms.get(declared["name"])
        if uniform is None or not all(isinstance(rule, Constant) for rule in uniform.rules):
            return declared[0]
        name, kind = declared["name"], declared["type"]
        values = [float(value) for rule in uniform.rules if isinstance(rule, Constant) for value in rule.value]
        size = COMPONENTS[uniform.type]
        items = [f"{kind}({', '.join(map(repr, values[i : i + size]))})" for i in range(0, len(values), size)]
        if declared["size"]:
            return f"const {kind} {name}[{len(items)}] = {kind}[{len(items)}]({', '.join(items)});"
        return f"const {kind} {name} = {items[0]};"

    return with_surface(plan, _DECLARED.sub(constant, _surface(plan).text))


def _alone(plan: FramePlan) -> FramePlan:
    """The plan with only the surface's pass, which reads the targets of earlier frames."""
    alone = (spec for spec in plan.passes if spec.program == "surface")
    # It draws into the picture, because a pass that nothing reads is not drawn.
    return plan.model_copy(update={"passes": tuple(spec.model_copy(update={"target": "screen"}) for spec in alone)})


def same_picture(executor: Executor, plan: FramePlan, other: FramePlan, camera: Camera) -> Difference:
    """Difference of the pictures. Raises ``RuntimeError`` if it exceeds that of rounding."""
    differences = []
    for time in PICTURE_TIMES:
        pictures = [
            executor.render(variant, time=time, camera=camera, width=SIZE[0], height=SIZE[1], output="linear").pixels
            for variant in (plan, other)
        ]
        seen = [np.clip(picture[..., :3].astype(np.float64), 0.0, 1.0) for picture in pictures]
        differences.append(np.abs(seen[0] - seen[1]).max(axis=-1))
    difference = Difference(float(np.max(differences)), float(np.mean(np.array(differences) > HALF_A_LEVEL)))
    if difference.share > FLIPPED:
        raise RuntimeError(f"programs that should draw the same do not: {difference}")
    return difference


def _compiled(
    executor: Executor, plans: Mapping[str, FramePlan], camera: Camera, rounds: Iterable[int]
) -> dict[str, list[Cost]]:
    """Cost of a program until its first pixels, minus the cost of the same pixels drawn again."""
    costs: dict[str, list[Cost]] = {name: [] for name in plans}
    for _ in rounds:
        for name, plan in plans.items():
            fresh = _alone(_fresh(plan))
            first, again = (cost(executor, fresh, camera, COMPILE_SIZE, 0.0) for _ in range(2))
            costs[name].append(Cost(first.wall - again.wall, first.cpu - again.cpu))
    return costs


def _fresh(plan: FramePlan) -> FramePlan:
    """The plan with a surface program that no driver has cached: it adds a different invisible number each time.

    A comment does not suffice: Mesa caches machine code by the translated program.
    """
    head, _, tail = _surface(plan).text.rpartition("}")
    return with_surface(plan, f"{head}    o_color += 1e-30 * {clock.time_ns() % 10**7}.0;\n}}{tail}")
