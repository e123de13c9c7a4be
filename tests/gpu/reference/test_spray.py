"""Spray against its closed form, the statistics of its births, and what it starts from and ends on.

docs/formulae.md, section 13. The float64 form takes births from the GPU: what judges them is the float64 surface, and
means over many drops.
"""

import math
from functools import partial

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
from seafoam.quality import TIERS
from seafoam.reference import spray as flying
from seafoam.reference.noise import number
from seafoam.reference.shore.shore import Coast
from seafoam.reference.types import Relief
from seafoam.reference.waves.parametric import wave_set
from seafoam.reference.waves.rings import ring_set
from seafoam.reference.waves.sea import sea_surface
from seafoam.render.gl.executor import Executor
from seafoam.render.service.jobs import measure
from seafoam.scene import Camera, Scene, load_preset
from seafoam.scene.light import Light
from seafoam.scene.shore import Shore, Surf
from seafoam.scene.spray import Burst, Spray
from seafoam.scene.waves import ParametricWave, Ring, Sea, WaveGroups
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


def aloft(
    executor: Executor, scene: Scene, time: float
) -> tuple[flying.Drops, NDArray[np.float64], NDArray[np.float64]]:
    """Drops in the air, where they are (n, 3), m from the eye's place at sea level, and their optical depths and radii
    (2, n)."""
    spray = scene.spray
    assert spray is not None
    drops = flying.Drops.of(births(executor, scene, time).astype(np.float32))
    of, vary = flying.KINDS[drops.kind.astype(np.intp)], number(drops.seed, 6)
    wind = (spray.wind_speed * math.cos(spray.downwind), spray.wind_speed * math.sin(spray.downwind))
    tau = of["drag"] * spray.drag * (0.6 + 0.8 * vary)
    wait = 0.0 if scene.shore else spray.life / BATCHES * number(drops.seed, 8) * of["wait"]
    rides = np.where(drops.kind == flying.DRIFT, np.minimum(wait, drops.age), 0.0)
    torn = drops.birth + rides[:, None] * drops.velocity * (1.0, 0.0, 1.0)
    place = flying.flight(torn, drops.velocity, drops.age - rides, tau, of["weight"], wind)[0]
    waited = drops.age - wait
    radius, depth, _ = flying.form(drops.kind, waited, drops.life, vary, number(drops.seed, 9))
    return drops, place, np.stack((depth * drops.strength, radius * drops.radius))


def test_spindrift_is_a_low_veil_along_the_wind(executor: Executor, report: Report) -> None:
    """Of storm, by what drops hide: densest at the crest that tears it off, thinner away from it and gone at 25 m (the
    swell is 183 m long); over raised water, and low."""
    scene = load_preset("storm").scene.settled
    spray, sea_of, origin = scene.spray, scene.sea, (scene.camera.position[0], scene.camera.position[2])
    assert spray is not None
    assert sea_of is not None
    downwind, crest = (math.cos(spray.downwind), math.sin(spray.downwind)), np.array(crest_velocity(sea_of))
    every = []
    for time in (44.0, 44.25, 44.5, 44.75):  # of batches of 1 s
        drops, place, (depth, radius) = aloft(executor, scene, time)
        assert (drops.kind == flying.DRIFT).all()
        gone = (place[:, ::2] - drops.birth[:, ::2] - crest * drops.age[:, None]) @ downwind
        every.append(np.stack((gone, depth * radius**2)))
    away, hides = np.concatenate(every, axis=1)
    share = np.histogram(away, [-2.0, 5.0, 10.0, 15.0, 20.0, 25.0], weights=hides)[0] / hides.sum()
    sea, anywhere = sea_surface(scene, time, origin), np.random.default_rng(1).uniform(-150.0, 150.0, (2, 5000))
    assert sea is not None
    waves = wave_set(scene, time, origin)
    water, level = (sea.height(*at) + waves.height(*at) for at in (place[:, ::2].T, anywhere))
    over, seen = place[:, 1] - water, every[-1][1] * (place[:, 1] > water)
    raised = (np.average(water, weights=seen) - level.mean()) / level.std()
    low, lowest = (float(np.average(over < most, weights=seen)) for most in (4.0, 1.0))
    report.add(
        "Spindrift of storm: shares of each 5 m from its crest; deviations by which its water is up; below 1 and 4 m",
        got=f"{np.round(share, 3)}; {raised:.2f}; {lowest:.2f}, {low:.2f}",
    )
    assert share.sum() == pytest.approx(1.0)
    assert (np.diff(share) < 0.0).all()
    assert share[2:].sum() < 1.0 / 3.0
    assert raised > 0.25
    assert lowest > 0.6
    assert low > 0.98


def test_an_explosion_is_a_column_then_a_surge_then_a_ring(executor: Executor) -> None:
    """Of the preset from its opening on, and again 45 s later: heights (m) of what is thrown up, the surge's width, and
    the radius at which the ring is highest."""
    found = load_preset("explosion")
    scene, opening = found.scene.settled, found.time
    (x, _, z), (middle_x, middle_z) = scene.camera.position, scene.rings[0].place
    turns, radii = np.linspace(0.0, 2.0 * math.pi, 24, endpoint=False), np.arange(1.0, 40.0, 0.5)
    ring = radii[:, None, None] * np.stack((np.cos(turns), np.sin(turns)), axis=-1) + (middle_x - x, middle_z - z)
    column, surge, crest, again = {}, {}, {}, {}
    for after in (0.0, 1.0, 3.0, 5.0, 14.0, 45.0):
        drops, place, (depth, _) = aloft(executor, scene, opening + after)
        seen = (place[:, 1] > 0.0) & (depth > 0.0)
        height, out = place[:, 1], np.hypot(place[:, 0] + x - middle_x, place[:, 2] + z - middle_z)
        column[after] = height[seen & (drops.kind == flying.COLUMN)].max(initial=0.0)
        surge[after] = [part[seen & (drops.kind == flying.MIST)].max(initial=0.0) for part in (height, out)]
        water = ring_set(scene, opening + after, (x, z)).height(*ring.reshape(-1, 2).T).reshape(radii.size, -1)
        crest[after], again[after] = radii[np.abs(water).mean(axis=1).argmax()], (height, water)
    assert column[0.0] > 6.0
    assert column[1.0] < 2.0
    assert surge[1.0][0] < 2.0
    assert surge[1.0][1] > surge[0.0][1] > 10.0
    assert column[3.0] == column[5.0] == surge[3.0][0] == 0.0
    assert 4.0 < crest[0.0] < crest[3.0] < crest[5.0] < 20.0
    assert column[14.0] > 10.0
    for first, second in zip(again[0.0], again[45.0], strict=True):
        assert first == pytest.approx(second, abs=0.02)


def test_sheets_go_up_rocks_and_fall_back_between_waves(executor: Executor) -> None:
    """Of spray-on-rocks, by the highest hundredth (m over still water): up with each wave and down before the next;
    mist outlasts them."""
    found = load_preset("spray-on-rocks")
    tops: dict[float, list[float]] = {}
    for after in (0.0, 0.8, 1.6, 4.0, 8.0):
        drops, place, (depth, _) = aloft(executor, found.scene.settled, found.time + after)
        seen = (place[:, 1] > 0.0) & (depth > 0.0)
        heights = [place[seen & (drops.kind == kind), 1] for kind in (flying.SHEET, flying.MIST)]
        tops[after] = [float(np.quantile(one, 0.99)) if one.size else 0.0 for one in heights]
    assert min(tops[0.0][0], tops[0.8][0]) > 5.0
    assert tops[0.8][0] > tops[1.6][0]
    assert tops[1.6][1] > 10.0
    assert tops[4.0] == [0.0, 0.0]
    assert tops[8.0][0] > 3.0
