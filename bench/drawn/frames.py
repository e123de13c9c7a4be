"""Frames: every look against the textured one, and every tier against the standard one, drawn side by side."""

import math
import time as clock
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from statistics import median
from typing import Literal, TypeVar, get_args

import numpy as np

from bench.report import Column, Spread, Table, count, extra, ms, percent, ratio_columns, times
from bench.watch import Watch
from seafoam.accuracy.metrics import Picture, coverage
from seafoam.doctor import SOFTWARE
from seafoam.framegraph.plan import FramePlan
from seafoam.planner import make_plan
from seafoam.quality import TIERS, Tier
from seafoam.render.gl.executor import Executor
from seafoam.scene import Camera, HeightSaturation, Look, Scene, load_preset, preset_names

PRESET = "paper-benchmark"
SIZE = (1280, 720)
TIER_SIZE = (640, 360)
COVERAGE_SIZE = (160, 90)
FINER = 4
"""Reference frames for coverage are this many times as wide and high, with 16 samples per pixel."""
COVERAGE_TIME = 2.7
BASE: Look = "textured"
COMPARED: tuple[tuple[Look, Look], ...] = (
    ("halftone_textured", "textured"),
    ("halftone", "textured"),
    ("filtered", "halftone"),
)
STEP = 0.37
"""Time of the sea between rounds, s, so that no figure depends on one arrangement of the foam."""

Basis = Literal["cpu", "wall"]
Name = TypeVar("Name", bound=str)


@dataclass(frozen=True)
class Cost:
    """Cost of a frame: seconds from the first call until it is finished, and processor time of all threads."""

    wall: float
    cpu: float


@dataclass(frozen=True)
class View:
    """A scene to draw with every look."""

    name: str
    title: str
    scene: Scene
    rounds: int
    seconds: float


def views() -> tuple[View, ...]:
    """The benchmark's sea, and two variants in which less and less is drawn besides the foam."""
    sea = load_preset(PRESET).scene
    assert sea.foam is not None
    half = (HeightSaturation(base=-1.0, full=1.0),)
    flat = sea.model_copy(
        update={
            "waves": (),
            "foam": sea.foam.model_copy(update={"saturation": half}),
            "camera": Camera(position=(0.0, 4.0, 0.0), pitch=-math.pi / 2, fov=0.9),
        }
    )
    bare = flat.model_copy(update={"light": None, "water": flat.water.model_copy(update={"ripples": None})})
    return (
        View("sea", f"preset {PRESET}", sea, 21, 60.0),
        View("flat", "a flat sea from 4 m straight above, half covered, lit, with ripples", flat, 40, 20.0),
        View("bare", "the same without light or ripples: foam and hardly more", bare, 40, 15.0),
    )


def measure(executor: Executor, watch: Watch) -> list[Table]:
    """Draw all frames and tabulate them."""
    basis: Basis = "cpu" if is_software(executor) else "wall"
    costs = {}
    for view in views():
        plans = {look: make_plan(with_look(view.scene, look), TIERS["standard"]) for look in get_args(Look)}
        rounds = watch.rounds(f"looks, {view.name}", view.rounds, view.seconds)
        costs[view.name] = side_by_side(executor, plans, view.scene.camera, SIZE, rounds)
    scene = load_preset(PRESET).scene
    tiers = {tier: make_plan(scene, quality) for tier, quality in TIERS.items()}
    tier_costs = side_by_side(executor, tiers, scene.camera, TIER_SIZE, watch.rounds("tiers", 7, 25.0))
    return [
        _comparisons(costs, basis),
        *(_looks(view, costs[view.name]) for view in views()),
        _presets(executor, watch),
        _tiers(tier_costs),
    ]


def is_software(executor: Executor) -> bool:
    """Whether the renderer runs on the processor."""
    return any(name in executor.info["renderer"].lower() for name in SOFTWARE)


def with_look(scene: Scene, look: Look) -> Scene:
    """The scene with its foam in another look."""
    assert scene.foam is not None
    return scene.model_copy(update={"foam": scene.foam.model_copy(update={"look": look})})


def side_by_side(
    executor: Executor, plans: Mapping[Name, FramePlan], camera: Camera, size: tuple[int, int], rounds: Iterable[int]
) -> dict[Name, list[Cost]]:
    """Draw all plans in each round, so that a round's ratios compare frames of about the same time.

    The order rotates and reverses from round to round, so that no plan is always first or always after the same one.
    """
    names = list(plans)
    costs: dict[Name, list[Cost]] = {name: [] for name in names}
    for name in names:
        # Compiles, uploads the textures, makes the targets.
        cost(executor, plans[name], camera, size, 0.0)
    for index in rounds:
        first = index % len(names)
        turned = [*names[first:], *names[:first]]
        for name in turned if index % 2 == 0 else reversed(turned):
            costs[name].append(cost(executor, plans[name], camera, size, STEP * index))
    return costs


def cost(executor: Executor, plan: FramePlan, camera: Camera, size: tuple[int, int], at: float) -> Cost:
    began = clock.process_time()
    rendered = executor.render(plan, time=at, camera=camera, width=size[0], height=size[1], output="rgba8")
    return Cost(rendered.timings["render"], clock.process_time() - began)


def _values(costs: Sequence[Cost], basis: Basis) -> list[float]:
    return [getattr(cost, basis) for cost in costs]


def ratios(costs: Sequence[Cost], base: Sequence[Cost]) -> tuple[Spread | None, Spread | None]:
    """Ratios of processor and wall time, per round; None for a plan against itself."""
    if costs is base:
        return None, None
    pairs = list(zip(costs, base, strict=True))
    return (
        Spread.of([mine.cpu / theirs.cpu for mine, theirs in pairs]),
        Spread.of([mine.wall / theirs.wall for mine, theirs in pairs]),
    )


def _comparisons(costs: Mapping[str, Mapping[Look, list[Cost]]], basis: Basis) -> Table:
    frame = median(_values(costs["sea"][BASE], basis))
    rows = []
    for view, by_look in costs.items():
        for look, base in COMPARED:
            pairs = zip(_values(by_look[look], basis), _values(by_look[base], basis), strict=True)
            added = median(mine - theirs for mine, theirs in pairs)
            rows.append(
                (
                    view,
                    f"{look} against {base}",
                    *ratios(by_look[look], by_look[base]),
                    1e9 * added / (SIZE[0] * SIZE[1]),
                    added / frame,
                    len(by_look[look]),
                )
            )
    return Table(
        "Halftone against textured",
        f"Frames of {SIZE[0]} x {SIZE[1]}, quality standard; medians of per-round ratios (interquartile range). Added: "
        f"the median difference in {'processor' if basis == 'cpu' else 'wall'} time, per pixel and as a share of a "
        "textured frame of the sea.",
        (
            Column("view", "view"),
            Column("compared", "compared"),
            *ratio_columns(extra),
            Column("added_ns_per_pixel", "added, ns/pixel", lambda value: f"{value:+.1f}"),
            Column("added_share_of_sea", "added, of the sea", percent),
            Column("rounds", "rounds", count),
        ),
        rows,
    )


def _looks(view: View, costs: Mapping[Look, list[Cost]]) -> Table:
    return Table(
        f"Looks, {view.name}",
        f"{view.title}; {SIZE[0]} x {SIZE[1]}, quality standard, against {BASE}; {len(costs[BASE])} rounds.",
        (
            Column("look", "look"),
            *ratio_columns(extra),
            Column("cpu", "processor, ms", ms),
            Column("wall", "wall, ms", ms),
        ),
        [
            (look, *ratios(taken, costs[BASE]), median(_values(taken, "cpu")), median(_values(taken, "wall")))
            for look, taken in costs.items()
        ],
    )


def _presets(executor: Executor, watch: Watch) -> Table:
    """Filtered against halftoned foam, one sample per pixel each, in every preset with foam."""
    looks: tuple[Look, Look] = ("halftone", "filtered")
    # Features that the halftone look lacks are disabled in the filtered look.
    plain = {"texture": 0.0, "fade": 0.0, "octaves": 1}
    rows = []
    for name in preset_names():
        scene = load_preset(name).scene
        if scene.foam is None:
            continue
        bare = scene.model_copy(update={"foam": scene.foam.model_copy(update=plain)})
        plans = {look: make_plan(with_look(bare, look), TIERS["standard"]) for look in looks}
        rounds = watch.rounds(f"filtered, {name}", 15, 12.0, least=3)
        hard, soft = side_by_side(executor, plans, scene.camera, TIER_SIZE, rounds).values()
        with watch.step(f"coverage, {name}"):
            hard_error = _coverage_error(executor, with_look(bare, "halftone"), 16)
            soft_error = _coverage_error(executor, with_look(bare, "filtered"), 1)
        rows.append(
            (
                name,
                *ratios(soft, hard),
                median(_values(hard, "cpu")),
                median(_values(soft, "cpu")),
                len(hard),
                hard_error,
                soft_error,
                soft_error / hard_error if hard_error > 0.0 else None,
            )
        )
    return Table(
        "Filtered against halftone, every preset",
        f"Both once a pixel, without foam texture or fade, {TIER_SIZE[0]} x {TIER_SIZE[1]}, quality standard; medians "
        f"of per-round ratios (interquartile range). Coverage: root mean square error at {COVERAGE_SIZE[0]} x "
        f"{COVERAGE_SIZE[1]} against the same look {16 * FINER * FINER} times a pixel.",
        (
            Column("preset", "preset"),
            *ratio_columns(extra),
            Column("halftone", "halftone, ms", ms),
            Column("filtered", "filtered, ms", ms),
            Column("rounds", "rounds", count),
            Column("halftone_error", "coverage, halftone 16 times", lambda value: f"{value:.4f}"),
            Column("filtered_error", "filtered once", lambda value: f"{value:.4f}"),
            Column("error_ratio", "ratio", lambda value: f"{value:.2f}"),
        ),
        rows,
    )


def _coverage_error(executor: Executor, scene: Scene, samples: int) -> float:
    """Root mean square error of foam coverage, 0 to 1, with a number of samples per pixel."""
    width, height = COVERAGE_SIZE
    many = _picture(executor, scene, 16, (FINER * width, FINER * height))
    means = many.reshape(height, FINER, width, FINER, 4).mean(axis=(1, 3))
    return coverage(_picture(executor, scene, samples, COVERAGE_SIZE), means)


def _picture(executor: Executor, scene: Scene, samples: int, size: tuple[int, int]) -> Picture:
    plan = make_plan(scene, TIERS["standard"].model_copy(update={"samples": samples}))
    width, height = size
    drawn = executor.render(plan, time=COVERAGE_TIME, camera=scene.camera, width=width, height=height, output="linear")
    return drawn.pixels.astype(np.float64)


def _tiers(costs: Mapping[Tier, list[Cost]]) -> Table:
    return Table(
        "Tiers of quality",
        f"Preset {PRESET}, {TIER_SIZE[0]} x {TIER_SIZE[1]}, against standard; {len(costs['standard'])} rounds.",
        (
            Column("tier", "tier"),
            Column("samples", "samples a pixel", count),
            *ratio_columns(times),
            Column("cpu", "processor, ms", ms),
            Column("wall", "wall, ms", ms),
        ),
        [
            (
                tier,
                TIERS[tier].samples,
                *ratios(taken, costs["standard"]),
                median(_values(taken, "cpu")),
                median(_values(taken, "wall")),
            )
            for tier, taken in costs.items()
        ],
    )
