"""Spray against its closed form, and what it is born from and ends on (docs/formulae.md, section 13)."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.effects.spray.spray import contribute, fastest_rise
from seafoam.framegraph.evaluation import FrameState, evaluate
from seafoam.ocean.rocks import ROCKS, rocks
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.reference.renderer.relief import Relief
from seafoam.reference.shore.shore import Coast
from seafoam.reference.spray import spray as flying
from seafoam.reference.waves.parametric import wave_set
from seafoam.render.gl.executor import Executor
from seafoam.scene.camera import Camera
from seafoam.scene.models import Scene
from seafoam.scene.presets import load_preset
from seafoam.scene.shore import Shore, Surf
from seafoam.scene.spray import DROPS, Spray
from seafoam.scene.waves import ParametricWave
from support.exact import UNFILTERED
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
    return flying.flight(np.zeros_like(velocity), velocity, age, tau, np.full_like(up, weight), WIND)


@pytest.mark.parametrize("weight", [9.81, 1.5])
def test_flight_equals_its_closed_form(probe: Probe, report: Report, weight: float) -> None:
    values = throws(20_000)
    got = probe(
        ["lib/noise/hash.glsl", "spray/flight.glsl"],
        f"y.xyz = spray_flight(vec3(0.0), vec3(x.y, x.x, 0.0), x.z, x.w, {weight});",
        values,
        uniforms={"u_spray_wind": WIND},
    )[:, :3]
    worst = float(np.abs(got - flown(values, weight)).max())
    report.add("Drops on the GPU against their closed form, m", weight=f"{weight:g}", worst=f"{worst:.1e}")
    # Gravity and drag each carry a drop a hundred metres in float32, and differ by a few.
    assert worst <= 1e-3


def test_the_closed_form_solves_the_equation_of_motion() -> None:
    """v' = (w − v)/τ − g, by Runge and Kutta's fourth order in two thousand steps."""
    values = throws(200)
    values[:, 3] = np.maximum(values[:, 3], 0.2)
    up, across, age, tau = values.T
    velocity, place = np.column_stack([across, up, np.zeros_like(up)]), np.zeros((200, 3))
    step = (age / 2000.0)[:, None]

    def change(v: NDArray[np.float64]) -> NDArray[np.float64]:
        return (np.array([WIND[0], 0.0, WIND[1]]) - v) / tau[:, None] - np.array([0.0, 9.81, 0.0])

    for _ in range(2000):
        a = change(velocity)
        b = change(velocity + 0.5 * step * a)
        c = change(velocity + 0.5 * step * b)
        d = change(velocity + step * c)
        place += step * velocity + step * step / 6.0 * (a + b + c)
        velocity = velocity + step / 6.0 * (a + 2.0 * b + 2.0 * c + d)
    assert np.abs(place - flown(values, 9.81)).max() <= 1e-8


@pytest.mark.parametrize(("time", "place"), [(3.0, (0.0, 0.0)), (1e9, (1e7, -1e7))])
def test_births_on_waves_equal_their_float64_form(
    probe: Probe, report: Report, time: float, place: tuple[float, float]
) -> None:
    camera = Camera(position=(place[0], 5.0, place[1]))
    plan = make_plan(SCENE, UNFILTERED)
    state = FrameState(time, camera, 16, 9, 16, 9, 0)
    assert SCENE.spray is not None
    want = flying.from_waves(SCENE.spray, SCENE, wave_set(SCENE, time, place), time, place)
    call = "vec3 b; vec3 v; float age; uint word; bool born = spray_born(int(x.x), b, v, age, word);"
    got = [
        probe(
            [
                "lib/numbers.glsl",
                "waves/parametric.glsl",
                "lib/noise/hash.glsl",
                "spray/flight.glsl",
                "spray/waves.glsl",
            ],
            f"{call} y = vec4({part}, born ? 1.0 : 0.0);",
            np.arange(DROPS)[:, None],
            consts={
                "PARAMETRIC_COUNT": 2,
                "PARAMETRIC_KIND": (4, 0),
                "PARAMETRIC_ALIKE": False,
                "PARAMETRIC_SIGNAL": False,
                "PARAMETRIC_CARRIES": False,
                "SURFACE_FILTER": False,
            },
            uniforms={
                name: evaluate(uniform, state)
                for name, uniform in plan.uniforms.items()
                if name.startswith(("u_spray", "u_parametric"))
            },
        ).astype(np.float64)
        for part in ("b", "v")
    ]
    born = got[0][:, 3] > 0.0
    # Which water rises fastest, and whether fast enough, is decided by a comparison here and there.
    assert abs(int(born.sum()) - want.age.size) <= 0.002 * DROPS
    index = {tuple(np.round(birth, 2)): i for i, birth in enumerate(want.birth)}
    pairs = [(i, index[key]) for i in np.flatnonzero(born) if (key := tuple(np.round(got[0][i, :3], 2))) in index]
    assert len(pairs) >= 0.9 * want.age.size
    mine, theirs = np.array(pairs).T
    away = np.abs(got[0][mine, :3] - want.birth[theirs]).max()
    apart = np.abs(got[1][mine, :3] - want.velocity[theirs])
    report.add(
        "Births of drops on waves against float64", time=f"{time:g} s", place=f"{away:.1e} m", born=str(len(mine))
    )
    assert away <= 5e-3
    assert np.percentile(apart, 99.0) <= 2e-2


def test_waves_throw_drops_where_water_rises_fast() -> None:
    """At its birth a drop lies on the water, which rises faster than the threshold: by the waves of that time."""
    assert SCENE.spray is not None
    drops = flying.from_waves(SCENE.spray, SCENE, wave_set(SCENE, 40.0, (0.0, 0.0)), 40.0, (0.0, 0.0))
    assert drops.age.size > 100
    for i in range(0, drops.age.size, 200):
        x, z = drops.birth[i : i + 1, 0], drops.birth[i : i + 1, 2]
        heights = [
            wave_set(SCENE, 40.0 - float(drops.age[i]) + e, (0.0, 0.0)).height(x, z)[0] for e in (-1e-4, 0.0, 1e-4)
        ]
        assert heights[1] == pytest.approx(drops.birth[i, 1], abs=1e-9)
        assert (heights[2] - heights[0]) / 2e-4 > SCENE.spray.threshold - 1e-3
    assert fastest_rise(SCENE) < 10.0
    assert contribute(SCENE.model_copy(update={"spray": Spray(threshold=10.0)}), TIERS["standard"]).bound is not None  # type: ignore[union-attr]


def test_surf_throws_drops_from_rocks_after_its_crest() -> None:
    found = rocks(ROCK, 0.3)
    assert found.shape == (ROCKS, 4)
    assert np.abs(np.hypot(found[:, 2], found[:, 3]) - 1.0).max() <= 2e-3
    coast = Coast(ROCK, 20.0, (0.0, 0.0), Relief(()))
    height, g_x, g_z, _ = coast.ground(found[:, 0], found[:, 1])
    assert np.abs(height).max() <= 0.3
    assert np.hypot(g_x, g_z).min() >= 0.2
    spray = Spray()
    ages = []
    for time in (17.0, 18.5):
        coast = Coast(ROCK, time, (0.0, 0.0), Relief(()))
        drops = flying.from_rocks(spray, coast, time)
        phase = coast.field.value(drops.birth[:, 0], drops.birth[:, 2])[:, 0]
        since = (1.0 - coast.turn(phase)) * ROCK.surf.period
        assert (since >= drops.age).all()
        assert (since <= drops.age + flying.DELAY).all()
        ages.append(drops.age.size)
    assert max(ages) > DROPS // 2
    assert len(rocks(Shore(slope=0.05, roughness=0.0), 0.5)) == 0


def test_drops_end_on_water_and_ground() -> None:
    coast = Coast(ROCK, 17.5, (0.0, 0.0), Relief(()))
    drops = flying.from_rocks(Spray(), coast, 17.5)
    high = np.array([0.0, 300.0, 0.0])
    x, z = drops.birth[:, 0], drops.birth[:, 2]
    ground = np.maximum(coast.height(x, z), coast.ground(*coast.place(x, z))[0])
    for lift, hidden in ((0.05, False), (-0.05, True)):
        place = np.column_stack([x, ground + lift, z])
        assert (flying._hidden(place, place - high, 300.0, coast, coast) == hidden).all()


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
