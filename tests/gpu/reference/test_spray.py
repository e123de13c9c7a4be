"""Spray against its closed form, the statistics of its births, and what it starts from and ends on.

docs/formulae.md, section 13. The float64 form takes births from the GPU: what judges them is the float64 surface, and
means over many drops.
"""

import math
from functools import partial
from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.accuracy.truth import sprayed
from seafoam.effects.spray.spray import EFFECT
from seafoam.ocean.coast.rocks import rocks
from seafoam.ocean.foam.spray import (
    BATCHES,
    LEVELS,
    cell_sides,
    crest_strength,
    crest_velocity,
    fold_limits,
    torn_share,
)
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.reference import spray as flying
from seafoam.reference.shore.shore import Coast
from seafoam.reference.types import Relief
from seafoam.reference.waves.parametric import wave_set
from seafoam.reference.waves.rings import ring_set
from seafoam.reference.waves.sea import sea_surface
from seafoam.render.gl.executor import Executor
from seafoam.render.service.jobs import measure
from seafoam.scene.camera import Camera
from seafoam.scene.light import Light
from seafoam.scene.models import Scene
from seafoam.scene.presets import load_preset
from seafoam.scene.shore import Shore, Surf
from seafoam.scene.spray import Burst, Spray
from seafoam.scene.waves import ParametricWave, Ring, Sea, WaveGroups
from support.pictures import draw
from support.probe import Probe
from support.report import Report

WAVES = (
    ParametricWave(amplitude=1.5, wavelength=20.0, direction=1.6, exponent=2.0),
    ParametricWave(amplitude=0.6, wavelength=9.0, direction=2.1, exponent=1.3),
)
SCENE = Scene(waves=WAVES, spray=Spray(threshold=1.0))
ROCK = Shore(
    kind="island", size=120.0, radius=11.0, depth=9.0, slope=0.9, smoothing=3.0, surf=Surf(height=2.6, period=8.0)
)
WIND = (2.0, -3.0)


def throws(count: int) -> NDArray[np.float64]:
    """Speeds upward and across (m/s), ages (s), times to 1/e (s)."""
    random = np.random.default_rng(3)
    values = np.column_stack(
        [
            random.uniform(0.0, 20.0, count),
            random.uniform(-10.0, 10.0, count),
            random.uniform(0.0, 8.0, count),
            np.exp(random.uniform(math.log(0.03), math.log(14.0), count)),
        ]
    )
    return values.astype(np.float32).astype(np.float64)


def flown(values: NDArray[np.float64], weight: float) -> NDArray[np.float64]:
    up, across, age, tau = values.T
    velocity = np.column_stack([across, up, np.zeros_like(up)])
    return flying.flight(np.zeros_like(velocity), velocity, age, tau, np.full_like(up, weight), WIND)[0]


@pytest.mark.parametrize("weight", [9.81, 1.5])
def test_flight_equals_its_closed_form(probe: Probe, report: Report, weight: float) -> None:
    values = throws(20_000)
    got = probe(
        ["lib/noise.glsl@hash", "spray/drawn.glsl@flight"],
        f"y.xyz = spray_flight(vec3(0.0), vec3(x.y, x.x, 0.0), x.z, x.w, {weight});",
        values,
        uniforms={"u_spray_wind": WIND},
    )[:, :3]
    worst = float(np.abs(got - flown(values, weight)).max())
    # Gravity and drag each carry a drop a hundred metres in float32, and differ by a few.
    report.within("Drops on the GPU against their closed form, m", weight=weight, worst=(worst, 1e-3))


def test_the_closed_form_solves_the_equation_of_motion() -> None:
    """From a drop's birth, x' = v and v' = (w − v)/τ − g, by central differences."""
    values, step = throws(20_000), 1e-4
    values[:, 3] = np.maximum(values[:, 3], 0.2)
    up, across, age, tau = values.T
    thrown = np.column_stack([across, up, np.zeros_like(up)])
    begins, before, now, after = (
        flying.flight(np.zeros_like(thrown), thrown, since, tau, np.full_like(up, 9.81), WIND)
        for since in (np.zeros_like(age), age - step, age, age + step)
    )
    assert max(np.abs(begins[0]).max(), np.abs(begins[1] - thrown).max()) <= 1e-12
    moved, sped = ((late - early) / (2.0 * step) for early, late in zip(before, after, strict=True))
    assert np.abs(moved - now[1]).max() <= 1e-5
    pull = (np.array([WIND[0], 0.0, WIND[1]]) - now[1]) / tau[:, None] - np.array([0.0, 9.81, 0.0])
    assert np.abs(sped - pull).max() <= 1e-4


STORM = Scene(
    sea=Sea(wind=22.0, fetch=250000.0, wind_direction=1.45, seed=9),
    spray=Spray(reach=300.0, wind=14.0, wind_direction=1.45, life=3.0),
    light=Light(),
    camera=Camera(position=(120.0, 18.0, -40.0), yaw=-0.25, pitch=-0.13),
)
CHOP = Scene(
    sea=Sea(model="gerstner", wind=9.0, fetch=20000.0),
    waves=WAVES[1:],
    rings=(Ring(place=(3.0, -12.0), birth=-6.0, amplitude=0.4),),
    spray=Spray(reach=40.0, threshold=0.6),
)


GROUPED = SCENE.model_copy(update={"wave_groups": WaveGroups(size=12.0, contrast=0.6)})


def births(executor: Executor, scene: Scene, time: float) -> NDArray[np.float64]:
    """The GPU's table of drops: birth and age, velocity and radius, strength, kind, seed and life; (3, n, 4)."""
    found = sprayed(partial(measure, executor), scene, time)
    assert isinstance(found, flying.Sprayed)
    return found.drops.astype(np.float64)


BEACH = Scene(
    shore=Shore(size=200.0, depth=6.0, slope=0.08, surf=Surf(height=1.4, period=7.0)),
    sea=Sea(wind=6.0, fetch=8000.0),
    waves=WAVES[1:],
    spray=Spray(threshold=0.6, reach=80.0, life=2.0),
    camera=Camera(position=(0.0, 4.0, 30.0), pitch=-0.1),
)


def surface(scene: Scene, time: float, x: NDArray[np.float64], z: NDArray[np.float64]) -> NDArray[np.float64]:
    """The drawn surface's height in float64, m, at places from the camera."""
    origin = (scene.camera.position[0], scene.camera.position[2])
    total = np.zeros_like(x)
    sea = sea_surface(scene, time, origin)
    if sea is not None:
        total += sea.height(x, z)
    if scene.waves:
        total += wave_set(scene, time, origin).height(x, z)
    total += ring_set(scene, time, origin).height(x, z)
    if scene.shore is None:
        return total
    parts = (wave_set(scene, time, origin), *(() if sea is None else (sea,)))
    return Coast(scene.shore, time, origin, Relief(parts)).height(x, z)


FAR = 1e7


def moved(scene: Scene, x: float, z: float) -> Scene:
    """The scene with camera and shore elsewhere."""
    (eye_x, height, eye_z), shore = scene.camera.position, scene.shore
    place = {"camera": scene.camera.model_copy(update={"position": (eye_x + x, height, eye_z + z)})}
    if shore is not None:
        place["shore"] = shore.model_copy(update={"place": (shore.place[0] + x, shore.place[1] + z)})
    return scene.model_copy(update=place)


@pytest.mark.parametrize(
    ("name", "scene", "time"),
    [
        ("storm by FFT, after ten days, 10 000 km away", moved(STORM, FAR, -FAR), 1e6),
        ("Gerstner sea, single waves and a ring", CHOP, 3.0),
        ("single waves in groups", GROUPED, 40.0),
        ("single waves, after thirty years, 10 000 km away", moved(SCENE, FAR, -FAR), 1e9),
        ("surf on a beach, sea and single waves, after ten days, 10 000 km away", moved(BEACH, FAR, -FAR), 1e6),
    ],
)
def test_drops_start_on_the_drawn_surface(
    executor: Executor, report: Report, name: str, scene: Scene, time: float
) -> None:
    """Within 1 cm of the float64 surface of the time of their birth."""
    table = births(executor, scene, time)
    born = table[2, :, 0] > 0.0
    place = table[0, born]
    worst = 0.0
    for age in np.unique(place[:, 3]):
        batch = place[place[:, 3] == age][:1000]
        height = surface(scene, time - float(age), batch[:, 0], batch[:, 2])
        worst = max(worst, float(np.abs(height - batch[:, 1]).max()))
    assert born.sum() > 100
    report.within("Births of drops against the float64 surface, m", scene=name, born=born.sum(), worst=(worst, 0.01))


ROCKY = Scene(
    shore=ROCK, waves=WAVES, rings=CHOP.rings, spray=Spray(life=4.0), camera=Camera(position=(-30.0, 5.0, 10.0))
)


@pytest.mark.parametrize(
    ("scene", "time"),
    [(ROCKY.model_copy(update={"wave_groups": WaveGroups(size=9.0)}), 17.0), (moved(ROCKY, FAR, -FAR), 1e9 - 7.0)],
    ids=["groups", "after thirty years, 10 000 km away"],
)
def test_drops_start_on_the_surf_at_rocks(executor: Executor, report: Report, scene: Scene, time: float) -> None:
    """The same where surf breaks on rocks, each drop at its own time."""
    eye, shore = (scene.camera.position[0], scene.camera.position[2]), scene.shore
    assert shore is not None
    table = births(executor, scene, time)
    born = np.flatnonzero(table[2, :, 0] > 0.0)
    worst = 0.0
    for i in born[:: max(born.size // 40, 1)]:
        x, height, z, age = table[0, i]
        then = time - float(age)
        coast = Coast(shore, then, eye, Relief((wave_set(scene, then, eye), ring_set(scene, then, eye))))
        worst = max(worst, abs(float(coast.height(np.array([x]), np.array([z]))[0]) - height))
    assert born.size > 1000
    report.within("Births of drops against the float64 surface, m", scene="rocks", born=born.size, worst=(worst, 0.01))
    assert len(rocks(Shore(slope=0.05, roughness=0.0), 0.5)) == 0


def test_surf_throws_drops_up_rocks_wave_by_wave(executor: Executor, report: Report) -> None:
    """Once a wave, at any age; as fast as its height would make it in the mean, most of it up, a fifth out to sea and
    none along the coast; as much mist as asked for."""
    shore = Shore(kind="island", size=120.0, radius=30.0, depth=9.0, slope=0.9, surf=Surf(height=2.6, period=8.0))
    scene = Scene(shore=shore, spray=Spray(life=4.0, threshold=0.0), camera=Camera(position=(0.0, 5.0, 0.0)))
    spray, every = scene.spray, []
    assert spray is not None
    for wave in range(12):
        time = 17.0 + wave * (1.0 + 1.0 / 12.0) * shore.surf.period
        table = births(executor, scene, time)
        coast = Coast(shore, time, (0.0, 0.0), Relief(()))
        x, z = table[0, :, 0], table[0, :, 2]
        height, ground = coast.field.value(x, z)[:, 1], np.stack(coast.ground(x, z)[1:3], axis=-1)
        out = -ground / np.hypot(*ground.T)[:, None]
        fall = spray.speed * np.sqrt(9.81 * np.maximum(height, 1e-6) / 0.3)
        flat = table[1, :, [0, 2]].T
        outward, along = (flat * out).sum(axis=1), flat[:, 1] * out[:, 0] - flat[:, 0] * out[:, 1]
        born = (table[2, :, 0] > 0.0) & (height > 0.05)
        every.append(
            np.stack((table[0, :, 3], table[1, :, 1] / fall, outward / fall, along / fall, table[2, :, 1]))[:, born]
        )
        assert (table[2, born, 3] == spray.life).all()
    age, up, outward, along, kind = np.concatenate(every, axis=1)
    rate = len(age) / (12.0 * table.shape[1])
    got = [rate, age.mean() / spray.life, up.mean(), outward.mean(), along.mean(), np.mean(kind == flying.MIST)]
    report.add("Surf on rocks: births, ages, speeds up, out and along, mist", got=str(np.round(got, 3)))
    # Of (0.3 + 0.7 u)(0.4 + 0.6 v)(0.25 + 0.75 w), upward times 0.9 and outward times 0.2 in the mean.
    fast = 0.65 * 0.7 * 0.625
    assert got == pytest.approx(
        [spray.life / shore.surf.period, 0.5, 0.9 * fast, 0.2 * fast, 0.0, spray.mist], abs=0.03
    )


def test_waves_throw_as_fast_as_they_rise(executor: Executor, report: Report) -> None:
    """Births of single waves: ages of two batches, one radius a grid, and mean speeds over the float64 rise."""
    spray = SCENE.spray
    assert spray is not None
    table = births(executor, SCENE, 40.0)
    (place, age), (velocity, radius), kind = (
        (table[0, :, [0, 2]].T, table[0, :, 3]),
        (table[1, :, :3], table[1, :, 3]),
        table[2, :, 1],
    )
    born = table[2, :, 0] > 0.0
    ages = np.unique(age[born])
    assert len(ages) == BATCHES
    assert np.diff(ages)[0] == pytest.approx(spray.life / BATCHES, abs=1e-5)
    radii = 1.4 * spray.size * np.array(cell_sides(spray))
    assert np.abs(radius[born, None] - radii).min(axis=1).max() <= 1e-5
    upward, ahead, aside = [], [], []
    for one in ages:
        batch = born & (age == one)
        waves = wave_set(SCENE, 40.0 - float(one), (0.0, 0.0))
        before, after = (wave_set(SCENE, 40.0 - float(one) + step, (0.0, 0.0)) for step in (-1e-4, 1e-4))
        rise = (after.height(*place[batch].T) - before.height(*place[batch].T)) / 2e-4
        slope = np.stack(waves.gradient(*place[batch].T), axis=-1)
        front = -slope * (rise / np.maximum((slope**2).sum(axis=1), 0.02))[:, None]
        flat, length2 = velocity[batch][:, ::2], (front**2).sum(axis=1)
        upward.append(velocity[batch, 1] / (spray.speed * rise))
        ahead.append((flat * front).sum(axis=1) / length2)
        aside.append((flat[:, 1] * front[:, 0] - flat[:, 0] * front[:, 1]) / length2)
    means = [float(np.concatenate(part).mean()) for part in (upward, ahead, aside)]
    report.add("Mean speeds of births over the waves': upward, ahead, aside", got=str(np.round(means, 3)))
    # Of (0.3 + 0.7 u)(0.3 + 0.7 v), 0.8 + 0.2 u + 0.2 v and 0.3 (u + v - 1), u of a cluster and v of its drop.
    assert means == pytest.approx([0.65**2, 1.0, 0.0], abs=0.03)
    assert np.concatenate(upward).max() <= 1.02
    assert np.mean(kind[born] == flying.MIST) == pytest.approx(spray.mist, abs=0.03)


def test_a_burst_throws_a_column_of_its_height(executor: Executor, report: Report) -> None:
    """Of its drops 62 % are of the column, 14 % of the crown and 24 % of the surge; the fastest would rise to 1.2 times
    the height without drag, and each starts in or at the rim of its foot."""
    burst = Burst(place=(3.0, -30.0), height=20.0, radius=2.0)
    scene = Scene(spray=Spray(bursts=(burst,)), light=Light())
    fastest, surge = math.sqrt(2.4 * 9.81 * burst.height), 0.16 * math.sqrt(2.4 * 9.81 * burst.height)
    table = births(executor, scene, 0.5 + surge)
    born = table[2, :, 0] > 0.0
    kind, up = table[2, born, 1], table[1, born, 1]
    rise = float((up**2).max()) / (2.0 * 9.81)
    report.add("Height to which a burst's fastest drop rises without drag, over the burst's", got=f"{rise / 20.0:.3f}")
    assert np.mean(kind == flying.COLUMN) == pytest.approx(0.76, abs=0.015)
    assert set(np.unique(kind)) == {flying.COLUMN, flying.MIST}
    assert 1.0 * burst.height < rise <= 1.2 * burst.height
    assert up[kind == flying.MIST].max() <= 0.13 * fastest * 1.001
    out = np.hypot(table[0, born, 0] - 3.0, table[0, born, 2] + 30.0)
    assert out.max() <= 1.001 * burst.radius
    assert np.abs(out[kind == flying.MIST] - burst.radius).max() <= 1e-3


def test_a_sea_without_single_waves_throws_drops_where_it_folds(executor: Executor) -> None:
    """Where drops are born the divergence is far below its mean of 0, and the more so the more opaque they are."""
    spray, sea_of = STORM.spray, STORM.sea
    assert spray is not None
    assert sea_of is not None
    table = births(executor, STORM, 52.0)
    # As fast as crests, spindrift by the wind, each grid at its distances.
    thrown = table[2, :, 0] > 0.0
    speed, kind, strong = table[1, thrown, :3], table[2, thrown, 1], crest_strength(sea_of)
    crest, torn = crest_velocity(sea_of), torn_share(sea_of, spray)
    assert speed[:, ::2].mean(axis=0) == pytest.approx(crest, abs=0.03 * math.hypot(*crest))
    shares = [np.mean(kind == one) for one in (flying.DRIFT, flying.MIST)]
    assert shares == pytest.approx([torn, (1.0 - torn) * spray.mist], abs=0.03)
    up = speed[kind != flying.DRIFT, 1] / (spray.speed * strong * math.hypot(*crest))
    assert 0.2 <= up.mean() / 0.65**2 <= 0.5
    assert 0.0 <= up.min() <= up.max() <= 0.5
    level = (np.arange(thrown.size) // BATCHES % LEVELS)[thrown]
    assert table[1, thrown, 3] == pytest.approx(
        1.4 * spray.size * np.array(cell_sides(spray))[level] * (0.4 + 0.6 * strong)
    )
    away = np.log2(np.hypot(*table[0, thrown][:, [0, 2]].T) / (0.5 * spray.reach * 2.0 ** (level - LEVELS + 1.0)))
    share = np.where((level == 0) & (away < 0.0), 1.0, 1.0 - np.abs(away))
    assert (table[2, thrown, 0] <= strong * share + 1e-4).all()
    born = table[2, :, 0] > 0.05
    place = table[0, born]
    limits = fold_limits(sea_of, spray, None)
    assert limits is not None
    origin = (STORM.camera.position[0], STORM.camera.position[2])
    for age in np.unique(place[:, 3]):
        batch = place[place[:, 3] == age]
        sea = sea_surface(STORM, 52.0 - float(age), origin)
        assert sea is not None
        folds = sea.folds(batch[:, 0], batch[:, 2])[0]
        assert np.mean(folds < limits[0]) >= 0.95
    calm = STORM.model_copy(update={"sea": sea_of.model_copy(update={"wind": 0.0})})
    assert EFFECT.contribute(calm, TIERS["standard"]).bound is not None  # type: ignore[union-attr]


def test_no_drop_is_left_at_rest(executor: Executor, report: Report) -> None:
    """All that was thrown falls: at the end of its life nothing of a drop is seen, and a burst leaves nothing."""
    kinds = np.repeat([flying.SHEET, flying.MIST, flying.DRIFT, flying.COLUMN], 50)
    vary = np.tile(np.linspace(0.0, 1.0, 50), 4)
    one = np.ones(200)
    assert flying.form(kinds, 2.5 * one, 2.5 * one, vary, vary)[1].max() == 0.0
    of, rest = flying.KINDS[kinds.astype(np.intp)], np.zeros((200, 3))
    _, late = flying.flight(rest, rest, 2.5 * one, 0.8 * of["drag"], of["weight"], (0.0, 0.0))
    assert late[:, 1].max() < -0.5
    scene = Scene(spray=Spray(bursts=(Burst(place=(0.0, -30.0)),)), light=Light(), camera=Camera(pitch=-0.1))
    plans = [make_plan(one, TIERS["standard"]) for one in (scene, scene.model_copy(update={"spray": None}))]
    changed = []
    for time in (-0.5, 1.0, 20.0):
        with_it, bare = (draw(executor, plan, scene.camera, time=time, size=(160, 90)).astype(float) for plan in plans)
        changed.append(float(np.abs(with_it - bare).mean()))
    report.add("Light that a burst changes before it, after 1 s and after 20 s", levels=str(np.round(changed, 3)))
    assert changed[0] == changed[2] == 0.0
    assert changed[1] > 0.3


def test_spray_flickers_no_more_than_twice_what_many_samples_do(executor: Executor, report: Report) -> None:
    """Under a slow camera: the change from frame to frame that spray adds, with one sample a pixel and with 64."""
    scene = load_preset("spray-on-rocks").scene.model_copy(
        update={"camera": Camera(position=(-88.0, 7.0, 48.0), yaw=1.12, pitch=-0.03, fov=0.35)}
    )
    added = {}
    for samples in (1, 64):
        quality = TIERS["standard"].model_copy(update={"samples": samples})
        plan, bare = (make_plan(scene.model_copy(update={"spray": spray}), quality) for spray in (scene.spray, None))
        layers = []
        for frame in range(4):
            camera = scene.camera.model_copy(update={"yaw": 1.12 + 0.0004 * frame})
            pictures = [
                draw(executor, one, camera, time=1.7, size=(160, 90), output="linear")[..., :3] for one in (plan, bare)
            ]
            layers.append(pictures[0] - pictures[1])
        added[samples] = float(np.mean([np.abs(b - a).mean() for a, b in pairwise(layers)]))
    report.within("Flicker of spray under a slow camera, one sample over 64", ratio=(added[1] / added[64], 2.0))


def test_fewer_drops_cover_as_much(executor: Executor, report: Report) -> None:
    """What spray changes in a picture."""
    scene = load_preset("spray-on-rocks").scene
    sums = {}
    for count in (2048, 8192, 16384):
        quality = TIERS["standard"].model_copy(update={"spray_count": count})
        bare = make_plan(scene.model_copy(update={"spray": None}), quality)
        pictures = [
            draw(executor, plan, scene.camera, time=1.7, size=(160, 90), output="linear")
            for plan in (make_plan(scene, quality), bare)
        ]
        sums[count] = float(np.abs(pictures[0][..., :3] - pictures[1][..., :3]).mean())
        report.add("Light that spray changes, by its drops", drops=str(count), mean=f"{255 * sums[count]:.2f} levels")
    assert sums[16384] > 1e-3
    assert all(abs(value / sums[16384] - 1.0) <= 0.2 for value in sums.values())
