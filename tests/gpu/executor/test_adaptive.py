"""More samples where a pixel needs them: which pixels, how many, and what they are then."""

import hashlib
import math

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.framegraph.plan import FramePlan, Fullscreen, Shader
from seafoam.planner import make_plan
from seafoam.planner.adaptive import MAX_CONTRAST, PARTS, RATIO
from seafoam.quality import TIERS, Quality, SurfaceQuality
from seafoam.render.gl.executor import Executor
from support.exact import SQUARE
from support.pictures import draw
from support.scenes import Camera, Scene, load_preset

SIZE = (96, 54)
NEXT_LIMIT = (MAX_CONTRAST / SQUARE.samples_threshold) ** (1.0 / 48.0)
"""Ratio of neighbouring limits in the last of three rounds."""


PLACE = "return gl_FragCoord.xy;"
TURNED = (
    "vec2 pixel = floor(gl_FragCoord.xy / float({n}));\n"
    "    vec2 within = floor(gl_FragCoord.xy) - float({n}) * pixel;\n"
    "    vec2 turned = vec2(within.y + 0.5, float({n}) - 0.5 - within.x) / float({n});\n"
    "    return float({n}) * pixel + within + turned;"
)
"""docs/formulae.md, section 1: where the samples of chosen pixels lie."""


def quality(base: Quality = SQUARE, **changes: object) -> Quality:
    return base.model_copy(update=changes)


def frame(
    executor: Executor,
    scene: Scene,
    how: Quality,
    size: tuple[int, int] = SIZE,
    camera: Camera | None = None,
    start: int = 1,
    chosen: int = 0,
) -> NDArray[np.float32]:
    """Linear frame at 2.7 s, (height, width, 4); marches begin as ``start`` samples along a pixel begin them.

    A march ends within a tolerance, and where it begins decides where in it. ``chosen``: every pixel has so many
    samples, set as those of chosen pixels are.
    """
    plan = make_plan(scene, quality(how, samples=chosen, samples_max=1) if chosen else how)
    if chosen:
        plan = as_chosen(plan, chosen)
    begun = {
        name: target.model_copy(update={"size": target.size.model_copy(update={"scale": start})})
        for name, target in plan.targets.items()
        if name.startswith("start")
    }
    plan = plan.model_copy(update={"targets": plan.targets | begun})
    seen = camera or scene.camera
    return draw(executor, plan, seen, time=2.7, size=size, output="linear")


def as_chosen(plan: FramePlan, count: int) -> FramePlan:
    """The plan of ``count`` samples everywhere, set as those of chosen pixels are."""
    programs = {}
    moved = TURNED.format(n=math.isqrt(count))
    for name, program in plan.programs.items():
        text = program.fragment.text.replace(PLACE, moved)
        shader = Shader(text=text, sha256=hashlib.sha256(text.encode()).hexdigest(), files=program.fragment.files)
        programs[name] = program.model_copy(update={"fragment": shader})
    return plan.model_copy(update={"programs": programs})


def contrast(one: NDArray[np.float32]) -> NDArray[np.float64]:
    """docs/formulae.md, section 1, in float64."""
    mean = one[..., :3].astype(np.float64).mean(axis=-1)
    rolled = np.pad(3.0 * mean / (2.0 + mean), 1, mode="edge")
    height, width = mean.shape
    round_it = np.stack([rolled[j : j + height, i : i + width] for j in range(3) for i in range(3)])
    cross = round_it[[1, 3, 4, 5, 7]].mean(axis=0)
    return np.sqrt((round_it[4] - cross) ** 2 + 0.5 * round_it.var(axis=0))


def same(a: NDArray[np.float32], b: NDArray[np.float32]) -> NDArray[np.bool_]:
    return (a == b).all(axis=-1)


@pytest.mark.parametrize(
    ("preset", "base"),
    [("default", "standard"), ("island-surf", "standard"), ("boat-race", "standard"), ("paper-halftone", "high")],
)
def test_a_chosen_pixel_is_what_as_many_samples_everywhere_make_it(executor: Executor, preset: str, base: str) -> None:
    """Bit for bit: a chosen pixel's samples are those of a finer picture, and are summed in the same order.

    With a shore a program of its own draws land over the whole picture; compiled apart its last bit may be another.
    """
    scene = load_preset(preset).scene
    start = quality(TIERS[base], samples_max=1, pixel_width=1)
    side = math.isqrt(start.samples)
    often = quality(start, samples_max=16, samples_budget=3.0)
    given = frame(executor, scene, often, start=side)
    least = frame(executor, scene, start, start=side)
    few, many = (frame(executor, scene, start, start=side, chosen=n) for n in (4, 16))
    as_one = same(given, least) | same(given, few) | same(given, many)
    assert as_one.all() if scene.shore is None else as_one.mean() >= 0.999
    near = [np.isclose(given, one, rtol=2**-10).all(axis=-1) for one in (least, few, many)]
    assert np.any(near, axis=0).all()
    assert same(given, many)[~same(least, many)].mean() > 0.005
    assert (given == frame(executor, scene, often, start=side)).all()


@pytest.mark.parametrize("preset", ["default", "open-ocean", "swell", "storm", "paper-halftone"])
@pytest.mark.parametrize("budget", [0.5, 1.5, 2.5])
def test_the_pixels_that_stand_out_are_chosen_within_the_budget(executor: Executor, preset: str, budget: float) -> None:
    # Drops are drawn over the chosen samples.
    scene = load_preset(preset).scene.model_copy(update={"spray": None})
    how = quality(samples_max=16, samples_budget=budget)
    given = frame(executor, scene, how)
    least = frame(executor, scene, SQUARE)
    few, many = (frame(executor, scene, SQUARE, chosen=n) for n in (4, 16))
    level = np.select([same(given, many) & ~same(many, least), same(given, few) & ~same(few, least)], [2, 1], 0)
    stands_out = contrast(least)
    # Where 1, 4 and 16 samples make the same pixel nothing tells them apart.
    told = ~same(least, few) & ~same(few, many) & ~same(least, many)
    limit = stands_out[told & (level > 0)].min()
    assert limit >= 0.999 * how.samples_threshold
    want = np.where(stands_out > RATIO * limit, 2, np.where(stands_out >= limit, 1, 0))
    assert (level == want)[told].mean() > 0.995

    # A share of the parts' middles has its rays under the horizon; an eye among the waves may see water everywhere.
    camera = scene.camera
    under = 0.0
    tangent = math.tan(0.5 * camera.fov)
    for y in np.linspace(-1.0, 1.0, PARTS, endpoint=False) + 1.0 / PARTS:
        under += math.sin(camera.pitch) + y * tangent * math.cos(camera.pitch) < 0.0
    if camera.position[1] < make_plan(scene, how).top:
        under = PARTS
    allowed = budget * under / PARTS * level.size

    def cost(at: float) -> float:
        return float(np.where(stands_out > RATIO * at, 16, np.where(stands_out > at, 4, 0)).sum())

    assert cost(1.001 * limit) <= allowed
    # And the next lower limit that was tried would not have done.
    assert limit <= 1.001 * how.samples_threshold or cost(0.99 * limit / NEXT_LIMIT) > 0.99 * allowed


@pytest.mark.parametrize("size", [(1, 1), (5, 3), (23, 40), (24, 24), (65, 33), (130, 71)])
def test_any_size_has_room_for_all_that_is_chosen(executor: Executor, size: tuple[int, int]) -> None:
    scene = load_preset("paper-halftone").scene
    how = quality(samples_max=16, samples_budget=3.0, samples_threshold=0.001)
    given = frame(executor, scene, how, size)
    least = frame(executor, scene, SQUARE, size)
    few, many = (frame(executor, scene, SQUARE, size, chosen=n) for n in (4, 16))
    assert (same(given, least) | same(given, few) | same(given, many)).all()
    if min(size) > 4:
        assert (~same(given, least)).any()


def test_a_mesh_is_marched_where_more_samples_are_drawn(executor: Executor) -> None:
    scene = load_preset("default").scene
    drawn = quality(TIERS["fast"], surface=SurfaceQuality(method="mesh", cells=112, refine=2), pixel_width=1)
    how = quality(drawn, samples_max=16)
    plan = make_plan(scene, how)
    again = [one for one in plan.passes if one.name.startswith("surface, ")]
    assert again
    assert all(isinstance(one.mesh, Fullscreen) for one in again)
    surface = how.surface.model_copy(update={"method": "march"})
    marched = [frame(executor, scene, quality(how, surface=surface), chosen=n) for n in (4, 16)]
    given, least = frame(executor, scene, how), frame(executor, scene, drawn)
    found = [same(given, one) for one in (least, *marched)]
    assert np.logical_or.reduce(found).all()
    assert all(one.mean() > 0.01 for one in found)


def test_points_lie_over_the_samples_of_chosen_pixels(executor: Executor) -> None:
    """Drops are drawn once over the picture: what more samples change about them is below what one drop covers."""
    scene = load_preset("spray-on-rocks").scene
    given = frame(executor, scene, quality(samples_max=16))
    many = frame(executor, scene, quality(samples=16))
    bare = frame(executor, scene.model_copy(update={"spray": None}), quality(samples_max=16))
    drops = np.abs(given - bare)[..., :3].max(axis=-1) > 0.02
    assert drops.mean() > 0.005
    error = np.abs(np.clip(given, 0.0, 1.0) - np.clip(many, 0.0, 1.0))[..., :3].mean(axis=-1)
    left_out = np.abs(np.clip(bare, 0.0, 1.0) - np.clip(many, 0.0, 1.0))[..., :3].mean(axis=-1)
    assert error[drops].mean() < 0.5 * left_out[drops].mean()
