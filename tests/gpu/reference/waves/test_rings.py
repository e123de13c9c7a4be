"""Rings: the shader's sums and map against float64, bounds, birth and death; rings of touches."""

import math
from dataclasses import replace
from random import Random

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.effects.effect import Contribution
from seafoam.effects.waves import rings as effect
from seafoam.effects.waves.rings import TOUCHES
from seafoam.framegraph.rules import afloat
from seafoam.ocean.waves.rings import ring_curvature, ring_height, ring_slope, trains
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.reference.waves.rings import RingSet, ring_set, touch_set
from seafoam.render.gl.executor import Executor
from support.exact import UNFILTERED
from support.pictures import linear, rmse
from support.probe import Probe
from support.report import Report
from support.scenes import (
    Camera,
    Current,
    Ring,
    Scene,
    Touch,
    Water,
    load_preset,
)

FILES = ("lib/numbers.glsl", "waves/rings.glsl@ring", "waves/rings.glsl@exact")
ORIGINS = ((0.0, 0.0), (1e7, -1e7))


def some_rings(time: float, place: tuple[float, float], seed: int, count: int = 24) -> tuple[Ring, ...]:
    """Rings of all kinds around a place, born in the last minute, some again and again."""
    r = Random(seed)
    made = []
    for i in range(count):
        decay = math.exp(r.uniform(math.log(0.05), math.log(2.0)))
        length = math.exp(r.uniform(math.log(0.3), math.log(60.0)))
        made.append(
            Ring(
                place=tuple(min(max(p + r.uniform(-40.0, 40.0), -1e7), 1e7) for p in place),
                birth=min(max(time - r.uniform(0.0, 4.0) / decay, -1e9), 1e9),
                every=6.0 / decay * r.uniform(1.0, 3.0) if i % 3 == 0 else None,
                amplitude=0.03 * length * r.uniform(0.2, 1.0),
                decay=decay,
                wavelength=length,
                crests=r.choice((None, 0.5, 3.0, 8.0)),
            )
        )
    return tuple(made)


def points(scene: Scene, origin: tuple[float, float], seed: int, count: int) -> NDArray[np.float32]:
    """Places in metres from the origin: near the rings' centres, over their reach, and beyond."""
    rng = np.random.default_rng(seed)
    every = trains(scene)
    picked = rng.integers(0, len(every), count)
    centre = np.array([train.ring.place for train in every])[picked] - np.array(origin)
    reach = np.array([train.reach for train in every])[picked]
    angle, share = rng.uniform(0.0, 2.0 * math.pi, count), rng.random(count) ** 2 * 1.1
    share[: count // 20] *= 1e-4
    way = (reach * share)[:, None] * np.stack((np.cos(angle), np.sin(angle)), axis=-1)
    return (centre + way).astype(np.float32)


def given(scene: Scene) -> Contribution:
    return effect.EFFECT.contribute(scene, UNFILTERED)


def shader(probe: Probe, scene: Scene, time: float, origin: tuple[float, float], at: NDArray[np.float32]) -> NDArray:
    """Height and gradient by the shader's sum, (n, 3)."""
    body = "y.xyz = rings_waves(x.xy);"
    return probe.contributed(given(scene), FILES, body, at, time=time, origin=origin)[:, :3]


def truth(scene: Scene, time: float, origin: tuple[float, float], at: NDArray[np.float32]) -> NDArray[np.float64]:
    x, z = at.astype(np.float64).T
    rings: RingSet = ring_set(scene, time, origin)
    return np.column_stack((rings.height(x, z), *rings.gradient(x, z)))


@pytest.mark.parametrize("origin", ORIGINS, ids=str)
@pytest.mark.parametrize("time", [0.0, 12.5, 3600.0, 1e9])
def test_rings_equal_float64_at_any_time_and_place(
    probe: Probe, report: Report, time: float, origin: tuple[float, float]
) -> None:
    scene = Scene(rings=some_rings(time, origin, 7), water=Water(depth=4.0))
    at = points(scene, origin, 3, 10000)
    got, want = shader(probe, scene, time, origin, at), truth(scene, time, origin, at)
    highest = ring_height(scene)
    assert want[:, 0].std() > 0.01 * highest
    # An age of 1e9 s less 1e9 s is as exact as float64's 1.2e-7 s.
    report.within(
        "Rings against float64, 24 rings, 10 000 places, height in m and slope",
        time=time,
        origin=origin[0],
        height=(np.abs(got - want)[:, 0].max(), 1e-5 * highest),
        slope=(np.abs(got - want)[:, 1:].max(), 2e-5 * ring_slope(scene)),
    )


def test_heights_and_slopes_stay_within_their_bounds() -> None:
    """Crowds of rings: no height, slope or curvature over its bound."""
    closest = 0.0
    for seed in range(12):
        scene = Scene(rings=some_rings(0.0, (0.0, 0.0), seed, count=3 + 5 * seed))
        highest, steepest, bend = ring_height(scene), ring_slope(scene), ring_curvature(scene)
        at = points(scene, (0.0, 0.0), seed, 1500)
        for time in (-3.0, 0.0, 1.7, 9.0):
            found = truth(scene, time, (0.0, 0.0), at)
            assert (np.abs(found[:, 0]) <= highest).all()
            assert (np.hypot(found[:, 1], found[:, 2]) <= steepest).all()
            closest = max(closest, float(np.abs(found[:, 0]).max() / highest))
            beside = truth(scene, time, (1e-3, 0.0), at)
            turned = np.hypot(*(beside - found)[:, 1:].T) / 1e-3
            assert (turned <= 1.01 * bend).all()
    assert closest > 0.2


@pytest.mark.parametrize("birth", [0.0, 1e9, -1e9])
def test_a_ring_is_born_from_still_water_at_its_centre(probe: Probe, birth: float) -> None:
    """At its birth and before it is level everywhere, its centre included; the slope there stays 0 afterwards."""
    ring = Ring(place=(0.0, 0.0), birth=birth, amplitude=1.0, wavelength=2.0)
    scene = Scene(rings=(ring,))
    at = np.array([[0.0, 0.0], [1e-20, 0.0], [1e-6, -1e-6], [0.1, 0.0], [3.0, 4.0]], np.float32)
    for age in (-1.0, 0.0):
        got = shader(probe, scene, birth + age, (0.0, 0.0), at)
        assert (got == 0.0).all()
    later = [shader(probe, scene, birth + age, (0.0, 0.0), at) for age in (0.1, 0.5, 1.0)]
    assert np.isfinite(later).all()
    assert (np.abs(np.array(later)[:, 0, 1:]) == 0.0).all()
    assert (np.abs(np.array(later)[:, :3, 1:]) < 1e-4).all()
    # Without the rounded tip the slope beside the centre would be that of a cone, k I0 sin(omega s).
    assert abs(later[1][3][1]) < 0.5 * math.pi


def test_a_dead_ring_leaves_no_trace(probe: Probe) -> None:
    ring = Ring(place=(0.0, 0.0), amplitude=0.5, decay=0.5, wavelength=3.0)
    scene = Scene(rings=(ring,))
    at = points(scene, (0.0, 0.0), 1, 500)
    for age in (ring.life + 1e-3, 1e3, 1e9):
        assert (shader(probe, scene, age, (0.0, 0.0), at) == 0.0).all()
    # It goes without a jump: a tenth of a second before, it is lower than a twentieth of what it dies at.
    last = shader(probe, scene, ring.life - 0.1, (0.0, 0.0), at)
    assert 0.0 < np.abs(last[:, 0]).max() <= 0.06 * ring.dead


def apart(executor: Executor, scene: Scene, camera: Camera, time: float, size: int) -> float:
    """RMSE in levels between frames with the map and with the sum."""
    frames = []
    for way in ("map", "exact"):
        quality = TIERS["standard"].model_copy(
            update={"rings": way, "rings_size": size, "target": "RGBA32F", "pixel_width": 1}
        )
        assert ("rings" in make_plan(scene, quality).targets) == (way == "map")
        frames.append(linear(executor, scene, quality, camera, time=time, size=(96, 54)))
    return rmse(*frames)


@pytest.mark.parametrize("preset", ["lake-calm", "explosion"])
def test_the_map_is_the_sum(executor: Executor, report: Report, preset: str) -> None:
    """Drawn into a texture and read back: what bilinear filtering and half floats leave of the exact sum."""
    found = load_preset(preset)
    scene = found.scene.model_copy(update={"foam": None, "waves": (), "sea": None, "spray": None})
    x, z = scene.rings[0].place
    over = scene.camera.model_copy(update={"position": (x, 14.0, z), "pitch": -math.pi / 2})
    own, above, finer = (
        apart(executor, scene, camera, found.time, size)
        for camera, size in ((scene.camera, 1024), (over, 1024), (over, 2048))
    )
    # Far off, waves are taken out by what the map knows of them together; the sum takes out each by itself. The bound
    # was 2.0 while footprints took out three times as much, and both stayed further from the truth. Explosion's rings
    # are the steepest, 1.6 levels from above, and a texel half as wide leaves half of it.
    report.within(
        "Dynamic displacement map against the sum, 96 × 54, RMSE in levels",
        preset=preset,
        own_camera=(own, 2.5),
        from_above=(above, 2.0),
        of_2048_texels=(finer, 0.7 * above + 0.02),
    )


def test_more_rings_than_a_word_has_bits_are_all_in_the_map(executor: Executor) -> None:
    rings = tuple(
        Ring(place=(8.0 * (i % 8), -8.0 * (i // 8)), birth=-1.0, amplitude=0.2, decay=0.4, wavelength=3.0)
        for i in range(40)
    )
    above = Camera(position=(28.0, 60.0, -16.0), pitch=-math.pi / 2)
    assert apart(executor, Scene(rings=rings), above, 0.0, 2048) < 1.0


TOUCH_FILES = ("lib/numbers.glsl", "waves/rings.glsl@ring", "waves/rings.glsl@touch")
FULL = "y.xyz = touches_detail(x.xy, Footprint(vec2(0.0), vec2(0.0)));"


def train(time: float, place: tuple[float, float] = (0.0, 0.0), count: int = 14) -> tuple[Touch, ...]:
    """What a finger leaves that was drawn over the water, and a strong touch beyond."""
    near = tuple(
        Touch(place=(place[0] + 0.4 * i - 2.5, place[1] - 4.5 - 0.15 * i), time=time - 2.4 + 0.15 * i)
        for i in range(count)
    )
    return (*near, Touch(place=(place[0] + 3.0, place[1] - 14.0), time=time - 2.0, strength=0.12))


@pytest.mark.parametrize("current", [None, Current(speed=2.0, direction=0.7)], ids=["still", "river"])
@pytest.mark.parametrize(("time", "origin"), [(0.0, (0.0, 0.0)), (12.5, (1e7, -1e7)), (1e8, (-300.0, 4e5))], ids=str)
def test_slopes_equal_float64_at_any_time_and_place(
    probe: Probe, report: Report, time: float, origin: tuple[float, float], current: Current | None
) -> None:
    place = np.clip(origin, -1e7 + 20.0, 1e7 - 20.0)
    scene = Scene(current=current, touches=train(time, (float(place[0]), float(place[1]))))
    made = TOUCHES.contribute(scene, UNFILTERED)
    # The planner moves what floats in a current.
    velocity = (0.0, 0.0) if current is None else current.velocity
    made = replace(made, uniforms={name: afloat(one, velocity) for name, one in made.uniforms.items()})
    at = np.random.default_rng(3).uniform(-12.0, 12.0, (20000, 2)).astype(np.float32)
    at += np.float32(place - np.array(origin) - (0.0, 6.0))
    got = probe.contributed(made, TOUCH_FILES, FULL, at, time=time, origin=origin)
    want = np.column_stack(touch_set(scene, time, origin).gradient(*at.astype(np.float64).T))
    assert np.abs(want).max() > 0.1
    assert (got[:, 2] == 0.0).all(), "nothing is left out where nothing is filtered"
    report.within(
        "Touches against float64, 15 rings, 20 000 places",
        time=time,
        origin=origin[0],
        current=current is not None,
        slope=(np.abs(got[:, :2] - want).max(), 1e-4),
    )


def test_no_touch_and_a_touch_to_come_leave_the_water_level(probe: Probe) -> None:
    for touches, time in (((Touch(time=5.0),), 4.9), ((Touch(strength=0.0),), 1.0), ((Touch(),), 9.0)):
        contribution = TOUCHES.contribute(Scene(touches=touches), UNFILTERED)
        at = np.random.default_rng(5).uniform(-12.0, 12.0, (2000, 2)).astype(np.float32)
        assert (probe.contributed(contribution, TOUCH_FILES, FULL, at, time=time) == 0.0).all()


def test_what_a_footprint_takes_out_is_roughness(probe: Probe) -> None:
    """Far off, the slopes are gone, and their mean square is where the glitter looks for it."""
    contribution = TOUCHES.contribute(Scene(touches=train(0.0)), UNFILTERED)
    at = np.random.default_rng(7).uniform(-6.0, 6.0, (4000, 2)).astype(np.float32) - np.array([0.0, 6.0], np.float32)
    wide = FULL.replace("vec2(0.0), vec2(0.0)", "vec2(9.0, 0.0), vec2(0.0, 9.0)")
    sharp, blurred = (probe.contributed(contribution, TOUCH_FILES, body, at, filtered=True) for body in (FULL, wide))
    assert np.abs(blurred[:, :2]).max() < 0.05 * np.abs(sharp[:, :2]).max()
    assert sharp[:, 2].max() < 1e-6
    # Crossing rings interfere, so the sum of squares is theirs only in the mean.
    assert blurred[:, 2].mean() == pytest.approx((sharp[:, :2] ** 2).sum(axis=1).mean(), rel=0.5)
