"""The executor: what it draws, and keeps between frames."""

import math
import subprocess
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from seafoam.effects.effect import ABOVE
from seafoam.framegraph.plan import Shader
from seafoam.framegraph.resources import ViewportSize
from seafoam.planner import FramePlan, make_plan, surface
from seafoam.quality import TIERS, Quality, SurfaceQuality, Tier
from seafoam.render.gl.executor import Executor, Output, ShaderError
from seafoam.scene import Camera
from support.pictures import ROUNDED, draw
from support.scenes import load_preset

STANDARD = TIERS["standard"]
FAULTS = """
import resource
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from seafoam.scene import load_preset
scene = load_preset("shallows").scene.model_copy(update={"boats": (), "foam": None, "waves": ()})
plan = make_plan(scene, TIERS["fast"].model_copy(update={"caustics_cells": 256}))
executor = Executor(optimized=False)
for frame in range(5):
    before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
    executor.render(plan, time=0.1 * frame, camera=scene.camera, width=64, height=36, output="rgba8")
    print(resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before)
"""
"""Page faults of frames with a grid of 288² cells."""


def test_memory_of_triangles_is_not_mapped_anew_in_each_frame() -> None:
    """Else about 1,900 pages are, at any size of picture, and 7,000 of the whole preset."""
    done = subprocess.run([sys.executable, "-c", FAULTS], check=True, capture_output=True, text=True)
    assert min(int(line) for line in done.stdout.split()[2:]) < 400


def test_programs_let_go_and_made_again_draw_the_same(executor: Executor, monkeypatch: pytest.MonkeyPatch) -> None:
    """GL hands the numbers of released programs to new ones: an array kept by number would feed the wrong program."""
    monkeypatch.setattr(executor._programs, "_size", 2)
    scene = load_preset("paper-threshold").scene
    meshes = [SurfaceQuality(method="mesh", cells=8 + i, steps=64 + i) for i in range(2)]
    plans = [make_plan(scene, STANDARD.model_copy(update={"surface": mesh})) for mesh in meshes]
    plans.append(make_plan(scene, STANDARD))

    def drawn(plan: FramePlan) -> bytes:
        return draw(executor, plan, scene.camera, time=1.0, size=(32, 18)).tobytes()

    first = [drawn(plan) for plan in plans]
    assert [drawn(plan) for plan in plans] == first
    assert len(executor._programs._items) <= 2


def test_all_let_go_and_made_again_draws_the_same(executor: Executor) -> None:
    """moderngl binds the last framebuffer again whenever it makes an object: it must not be one that was released."""
    scene = load_preset("pool-caustics").scene
    plan = make_plan(scene, TIERS["fast"])

    def drawn() -> bytes:
        return draw(executor, plan, scene.camera, time=1.0, size=(32, 18)).tobytes()

    first = drawn()
    executor.forget()
    assert drawn() == first


def test_16_bits_are_the_8_bits_before_they_are_rounded(executor: Executor) -> None:
    preset = load_preset("default")
    plan = make_plan(preset.scene, TIERS["fast"])
    asked = {"time": preset.time, "camera": preset.scene.camera, "width": 96, "height": 54}
    exact = executor.render(plan, output="rgba8", **asked).pixels
    fine = executor.render(plan, output="rgba16", **asked).pixels
    assert fine.dtype == np.uint16
    # And the last of the 16 bits.
    assert np.abs(fine / 257.0 - exact).max() <= ROUNDED + 1 / 257
    assert (executor.render(plan, output="rgba8", **asked).pixels == exact).all()


def test_a_shader_that_does_not_compile_names_its_files(executor: Executor) -> None:
    plan = make_plan(load_preset("default").scene, TIERS["standard"])
    program = plan.programs["present"]
    broken = program.fragment.text.replace("vec3 tone(vec3 x) {", "vec3 tone(vec3 x) { nonsense;")
    fragment = Shader(text=broken, sha256="0" * 64, files=program.fragment.files)
    with pytest.raises(ShaderError, match=r"output/tone\.glsl@photographic from line"):
        executor._program(program.model_copy(update={"fragment": fragment}))


def test_another_thread_is_refused(executor: Executor) -> None:
    scene = load_preset("default").scene
    plan = make_plan(scene, TIERS["standard"])
    with ThreadPoolExecutor(1) as pool, pytest.raises(RuntimeError, match="only in the thread that created it"):
        pool.submit(executor.render, plan, time=0.0, camera=scene.camera, width=8, height=8).result()


@pytest.fixture
def fresh(executor: Executor) -> Executor:
    """The executor with nothing kept."""
    executor._static.clear()
    return executor


@pytest.fixture
def drawn(fresh: Executor, monkeypatch: pytest.MonkeyPatch) -> Callable[..., list[str]]:
    """Draws a frame and gives the names of its passes."""
    names: list[str] = []
    draw_pass = fresh._draw

    def counted(plan: FramePlan, index: int, *rest: object) -> None:
        names.append(plan.passes[index].name)
        draw_pass(plan, index, *rest)

    monkeypatch.setattr(fresh, "_draw", counted)
    times = iter(range(100))

    def frame(plan: FramePlan, time: float | None = None) -> list[str]:
        names.clear()
        camera = load_preset("island-surf").scene.camera
        draw(fresh, plan, camera, time=float(next(times)) if time is None else time, size=(16, 9))
        return list(names)

    return frame


def setup_passes(names: list[str]) -> tuple[int, int]:
    """How many are of a shore's maps, and of masks."""
    return sum(name.startswith("shore: ") for name in names), sum(name.startswith("mask: ") for name in names)


def test_what_does_not_change_is_drawn_once_and_kept_for_all_plans_within_bounds(
    fresh: Executor, drawn: Callable[[FramePlan], list[str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = load_preset("island-surf").scene
    plan = make_plan(scene, STANDARD)
    first, second, third = (drawn(plan) for _ in range(3))
    # Eleven for each of two masks, and one that lays them over one another.
    assert (setup_passes(first), setup_passes(second)) == ((16, 23), (1, 0))
    still = {one.name for one in plan.passes if one.when == "setup"}
    assert second == third == [name for name in first if name not in still]
    assert len(fresh._static._items) == 3
    for shore, passes in (({"rock": (0.2, 0.1, 0.1)}, 1), ({"smoothing": 9.0}, 14)):
        other = scene.model_copy(update={"shore": scene.shore.model_copy(update=shore)})
        assert setup_passes(drawn(make_plan(other, STANDARD)))[0] == passes
    assert setup_passes(drawn(plan)) == (1, 0)
    monkeypatch.setattr(fresh._static, "_size", 0)
    drawn(plan)
    assert setup_passes(drawn(plan)) == (16, 23)


def test_a_target_whose_passes_failed_is_not_kept(fresh: Executor) -> None:
    scene = load_preset("island-surf").scene
    plan = make_plan(scene, STANDARD)
    broken = plan.programs["shore_blur"]
    fragment = broken.fragment.model_copy(update={"text": "#version 300 es\nbroken", "sha256": "0" * 64})
    programs = {**plan.programs, "shore_blur": broken.model_copy(update={"fragment": fragment})}
    with pytest.raises(ShaderError):
        draw(fresh, plan.model_copy(update={"programs": programs}), scene.camera, time=0.0, size=(16, 9))
    assert all(one.drawn is None for one in fresh._static._items.values())


def test_what_time_changes_in_steps_is_drawn_when_a_step_begins(
    fresh: Executor, drawn: Callable[..., list[str]]
) -> None:
    plan = make_plan(load_preset("storm").scene, STANDARD)
    births = [one.name for one in plan.passes if "at the births of drops" in one.name]
    assert len(births) == 9
    assert {one.when for one in plan.passes if one.name in births} == {"setup"}
    # A batch of drops is born at every whole second.
    frames = [[name for name in drawn(plan, time) if name in births] for time in (3.0, 3.9, 4.1, 4.2, 3.9, -0.5)]
    assert frames == [births, [], births, [], births, births]


@pytest.mark.parametrize("preset", ["island-surf", "drift-vortices", "storm"])
def test_a_frame_after_others_is_that_of_a_fresh_executor(preset: str, fresh: Executor) -> None:
    scene = load_preset(preset).scene
    plan = make_plan(scene, STANDARD)

    def at(time: float, one: FramePlan = plan) -> bytes:
        return draw(fresh, one, scene.camera, time=time, size=(48, 27)).tobytes()

    alone = at(7.3)
    fresh._static.clear()
    # The sky alone, in which the water's pass only clears its target.
    draw(fresh, plan, Camera(position=(3.0, 30.0, -2.0), pitch=math.pi / 2), time=0.0, size=(48, 27))
    at(1.0, make_plan(load_preset("lagoon").scene, STANDARD))
    at(2.0)
    assert at(7.3) == alone
    # And as it was where every pass is drawn in every frame.
    each = tuple(one.model_copy(update={"when": "frame"}) for one in plan.passes)
    assert at(7.3, plan.model_copy(update={"passes": each, "kept": {}})) == alone


SIZES = ((96, 54), (50, 7), (51, 7), (2, 3), (1, 1))


def narrow(width: int) -> Quality:
    return STANDARD.model_copy(update={"pixel_width": width})


def narrowed(
    executor: Executor, preset: str, quality: Quality, size: tuple[int, int], output: Output = "rgba8"
) -> NDArray[np.float64]:
    """A frame, (height, width, 4)."""
    found = load_preset(preset)
    plan = make_plan(found.scene, quality)
    return draw(executor, plan, found.scene.camera, time=found.time, size=size, output=output).astype(np.float64)


def along_rows(seen: NDArray[np.float64], x: NDArray[np.float64], cubic: bool) -> NDArray[np.float64]:
    """Rows (height, columns, 4) at places x (height, width) along them, columns: Catmull and Rom's cubic, or lines."""
    columns, first = seen.shape[1], np.floor(x).astype(int)
    f = (x - first)[..., None]
    p = [np.take_along_axis(seen, np.clip(first + step, 0, columns - 1)[..., None], 1) for step in (-1, 0, 1, 2)]
    rise, begins, ends = p[2] - p[1], 0.5 * (p[2] - p[0]), 0.5 * (p[3] - p[1])
    if not cubic:
        return p[1] + f * rise
    found = p[1] + f * begins + f**2 * (3.0 * rise - 2.0 * begins - ends) + f**3 * (begins + ends - 2.0 * rise)
    return np.clip(found, np.minimum(p[1], p[2]), np.maximum(p[1], p[2]))


def enlarged(picture: NDArray[np.float64], width: int, wide: int) -> NDArray[np.float64]:
    """What is shown of (height, columns, 4), the top row first; wide: of a column. docs/formulae.md, section 1."""
    colors = np.maximum(picture[..., :3], 0.0)
    seen = np.concatenate([colors / (1.0 + colors.max(-1, keepdims=True)), picture[..., 3:]], -1)
    height, columns = seen.shape[:2]
    # Rows count from the bottom.
    rows = np.arange(height)[::-1]
    shift = (0.125 if wide < 4 else 0.25) * np.where(rows % 2 == 0, -1.0, 1.0)[:, None]
    middle = (np.arange(width) + 0.5) / width * columns - 0.5
    own = along_rows(seen, middle - shift, wide < 4)
    f = (middle - shift) % 1.0
    mirrored = np.pad(np.arange(height), 1, mode="reflect")
    beside = np.clip(np.floor(middle + shift + 0.5).astype(int), 0, columns - 1)[..., None]
    around = sum(np.take_along_axis(seen[side], beside, 1) for side in (mirrored[:-2], mirrored[2:])) / 2.0
    share = ((0.15 if wide < 4 else 0.0) * 4.0 * f * (1.0 - f))[..., None]
    found = (1.0 - share) * own + share * around
    return np.concatenate([found[..., :3] / (1.0 - found[..., :3].max(-1, keepdims=True)), found[..., 3:]], -1)


@pytest.mark.parametrize("width", [2, 3, 4])
def test_what_is_drawn_narrow_is_enlarged_by_a_cubic_and_the_rows_beside(executor: Executor, width: int) -> None:
    quality = narrow(width).model_copy(update={"target": "RGBA32F"})
    for size in SIZES:
        samples = narrowed(executor, "default", quality, size, "samples")
        assert samples.shape[:2] == (size[1], -(-size[0] // width))
        want = enlarged(samples, size[0], width)
        np.testing.assert_allclose(narrowed(executor, "default", quality, size, "linear"), want, rtol=2e-4, atol=1e-5)


@pytest.mark.parametrize("preset", ["default", "coastline", "swell"])
def test_a_third_of_the_width_errs_less_than_fewer_pixels_along_both_axes(executor: Executor, preset: str) -> None:
    """As many samples either way, and a twelfth less error at least."""
    size = (320, 180)
    truth = narrowed(executor, preset, TIERS["high"], size)[..., :3]
    third = narrowed(executor, preset, narrow(3), size)[..., :3]
    small = narrowed(executor, preset, STANDARD, (185, 104)).astype(np.uint8)
    plain = np.asarray(Image.fromarray(small[..., :3]).resize(size, Image.Resampling.BICUBIC), np.float64)
    errors = [float(np.sqrt(np.square(picture - truth).mean())) for picture in (third, plain)]
    assert errors[0] < 0.92 * errors[1], errors


@pytest.mark.parametrize("tier", ["fast", "standard"])
def test_the_suns_disc_has_no_teeth(executor: Executor, tier: Tier) -> None:
    """The middle of its rows, which are shifted against one another, is off by half a pixel at most (0.8 without)."""
    found = load_preset("lake-sunset")
    camera = found.scene.camera.model_copy(update={"fov": 0.1, "pitch": 0.03, "yaw": 0.016})
    plan = make_plan(found.scene, TIERS[tier])
    sky = draw(executor, plan, camera, time=found.time, size=(160, 90), output="rgba8")[46:63, 60:100, :3].mean(-1)
    disc = sky - np.median(sky)
    disc[disc < 0.25 * disc.max()] = 0.0
    rows = disc[disc.sum(1) > 3.0 * disc.max()]
    assert len(rows) >= 6
    middles = rows @ np.arange(40.0) / rows.sum(1)
    assert np.abs(middles - middles.mean()).max() < 0.5


@pytest.mark.parametrize("preset", ["storm", "spray-on-rocks", "boat-race", "moonlight"])
def test_narrow_pixels_change_no_light_in_the_mean(executor: Executor, preset: str) -> None:
    """Drops, stars, boats and foam hide and light as much, however wide a pixel is: within two hundredths."""
    means = [narrowed(executor, preset, narrow(width), (192, 108), "linear").mean((0, 1)) for width in (1, 3)]
    np.testing.assert_allclose(means[1], means[0], rtol=0.02, atol=0.002)


@pytest.mark.parametrize(("preset", "most"), [("boat-race", 3), ("spray-on-rocks", 2)])
def test_what_stands_before_the_scenery_is_drawn_at_full_width(executor: Executor, preset: str, most: int) -> None:
    """Rays to drops begin where wider tiles of rays begin, and may end elsewhere within the tolerance: one in 100."""
    scene, exact = load_preset(preset).scene, SurfaceQuality(tolerance=0.01)
    qualities = [narrow(width).model_copy(update={"surface": exact}) for width in range(1, most + 1)]
    plans = [make_plan(scene, quality).model_copy(update={"linear": ABOVE}) for quality in qualities]
    above = [draw(executor, plan, scene.camera, time=10.0, size=(96, 54), output="linear") for plan in plans]
    assert above[0][..., 3].max() > 0.4
    for one in above[1:]:
        assert (np.abs(one - above[0]).max(-1) > 1e-3).mean() < 0.01


@pytest.mark.parametrize(("preset", "width", "part"), [("storm", 2, 4), ("spray-on-rocks", 3, 2)])
def test_spray_beside_wide_pixels_is_coarse_and_hides_as_much(
    executor: Executor, preset: str, width: int, part: int
) -> None:
    scene = load_preset(preset).scene
    plans = [make_plan(scene, narrow(wide)).model_copy(update={"linear": ABOVE}) for wide in (1, width)]
    assert [plan.targets["spray_thick"].size for plan in plans] == [ViewportSize(), ViewportSize(part=part)]
    # A storm's drops hide two pixels in 1000: one instant is off by up to a fifth, the mean of eight by two in 100.
    times = (3.0, 5.0, 9.0, 10.0, 11.0, 17.0, 20.0, 31.0)
    fine, coarse = (
        np.stack([draw(executor, plan, scene.camera, time=t, size=(192, 108), output="linear") for t in times])
        for plan in plans
    )
    assert coarse.shape[1] == 108 // part
    means = fine.reshape(len(times), 108 // part, part, 192 // part, part, 4).mean((2, 4))
    assert np.abs(coarse - means).mean((1, 2, 3)).max() < 0.02
    assert abs(coarse[..., 3].mean() / means[..., 3].mean() - 1.0) < 0.05


@pytest.mark.parametrize("height", [None, -1.0])
def test_samples_that_are_lit_by_another_program_give_the_same_picture(
    executor: Executor, monkeypatch: pytest.MonkeyPatch, height: float | None
) -> None:
    found = load_preset("coastline")
    camera = found.scene.camera.model_copy(update={} if height is None else {"height": height, "pitch": 0.3})
    plans = [make_plan(found.scene, TIERS["standard"])]
    make_plan.cache_clear()
    monkeypatch.setattr(surface, "_in_two", lambda frame: False)
    plans.append(make_plan(found.scene, TIERS["standard"]))
    make_plan.cache_clear()
    assert [surface.SAMPLES in plan.programs for plan in plans] == [True, False]
    two, one = (draw(executor, plan, camera, time=found.time, size=(96, 54)).astype(float) for plan in plans)
    assert one.std() > 10.0
    assert np.abs(two - one).max() <= 1.0
