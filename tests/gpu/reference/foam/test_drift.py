"""Drifting foam: the shader's flow, ways and patches against float64, an analytic vortex by step, maps both ways."""

import math
from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.effects.effect import Contribution, PlanError
from seafoam.effects.foam import drift as effect
from seafoam.ocean.waves import stokes
from seafoam.planner import make_plan
from seafoam.quality import TIERS, Quality
from seafoam.reference.foam import drift as truth
from seafoam.render.gl.executor import Executor
from support.exact import UNFILTERED
from support.pictures import draw_target
from support.probe import Probe
from support.report import Report
from support.scenes import Drift, DriftSaturation, Foam, ParametricWave, Scene, Sea, Vortex, Water

Floats = NDArray[np.float64]

FILES = (
    "lib/numbers.glsl",
    "foam/drift.glsl@square",
    "foam/drift.glsl@clock",
    "foam/drift.glsl@flow",
    "lib/noise.glsl@hash",
    "lib/noise.glsl@value",
    "foam/drift.glsl@patches",
    "foam/drift.glsl@ago",
    "foam/drift.glsl@back",
    "foam/saturation/drift.glsl@rim",
    "foam/saturation/drift.glsl@exact",
)
FOOTPRINT = "Footprint(vec2(0.0), vec2(0.0))"
STANDARD = TIERS["standard"]
SOURCE = DriftSaturation(life=20.0, patch=2.0)
EDDIES = (
    Vortex(place=(-6.0, -24.0), radius=1.6, speed=1.2),
    Vortex(place=(3.0, -30.0), radius=2.0, speed=-1.0),
    Vortex(place=(9.0, -38.0), radius=1.2, speed=0.7),
)
SCENE = Scene(
    drift=Drift(current=(0.35, -0.1), size=40.0, vortices=EDDIES),
    foam=Foam(saturation=(SOURCE,), look="halftone"),
)
STILL = SCENE.model_copy(update={"drift": Drift(current=(0.0, 0.0), size=40.0)})


def alone(vortex: Vortex) -> Scene:
    """One vortex in the middle of a square without any current."""
    return SCENE.model_copy(
        update={"drift": Drift(place=vortex.place, current=(0.0, 0.0), size=40.0, vortices=(vortex,))}
    )


def given(scene: Scene, quality: Quality) -> Contribution:
    contribution = effect.EFFECT.contribute(scene, quality)
    assert contribution is not None
    return contribution


def shader(
    probe: Probe,
    scene: Scene,
    body: str,
    at: Floats,
    time: float = 0.0,
    origin: tuple[float, float] = (0.0, 0.0),
    quality: Quality = UNFILTERED,
) -> Floats:
    contribution = given(scene, quality.model_copy(update={"drift": "exact"}))
    return probe.contributed(contribution, FILES, body, at.astype(np.float32), time=time, origin=origin)


def places(count: int, reach: float, seed: int = 3) -> Floats:
    """Places from the square's middle, as float32 holds them."""
    random = np.random.default_rng(seed)
    return random.uniform(-reach, reach, (count, 2)).astype(np.float32).astype(np.float64)


def drawn(executor: Executor, scene: Scene, quality: Quality, time: float, name: str = "drift") -> Floats:
    """A map of drift, row 0 at the least z."""
    return draw_target(executor, make_plan(scene, quality), name, time).astype(np.float64)


def texels(size: int, side: float) -> tuple[Floats, Floats]:
    """Middles of a map's texels from the square's, (size²,) each."""
    along = (np.arange(size) + 0.5) * (side / size) - 0.5 * side
    z, x = np.meshgrid(along, along, indexing="ij")
    return x.ravel(), z.ravel()


def generations(scene: Scene, time: float, x: Floats, z: Floats) -> Floats:
    """The four generations at places from the square's middle by the reference, (r, 4)."""
    flow = truth.flow_of(scene)
    generation = SOURCE.life / 4.0
    number, youngest = math.floor(time / generation), time % generation
    found = []
    for j in range(4):
        x, z = flow.back(x, z, youngest if j == 0 else generation)
        found.append(truth.patch(SOURCE, (number - j) % 1024, x, z))
    return np.stack(found, axis=-1)


def test_flow_equals_float64_right_into_the_centre(probe: Probe) -> None:
    near = np.geomspace(1e-12, 1.0, 400)[:, None] * np.array([[1.0, 0.3]])
    flow = truth.flow_of(SCENE)
    centres = np.array([vortex[:2] for vortex in flow.vortices])
    at = np.concatenate([places(8000, 30.0), centres, *(centre + near for centre in centres)])
    at = at.astype(np.float32).astype(np.float64)
    got = shader(probe, SCENE, "y.xy = drift_velocity(x.xy);", at)[:, :2]
    want = np.stack(flow.velocity(*at.T), axis=-1)
    assert np.isfinite(got).all()
    assert np.abs(got - want).max() < 2e-6


def test_a_vortex_is_fastest_at_its_radius_and_ends_at_six() -> None:
    square = np.linspace(0.0, 50.0, 200_001)
    speed = np.sqrt(square) * truth.angular_velocity(square, 1.0, 1.0)
    assert abs(math.sqrt(square[np.argmax(speed)]) - 1.0) < 1e-3
    assert abs(speed.max() - 1.0) < 1e-8
    assert (speed[square >= 36.0] == 0.0).all()


@pytest.mark.parametrize("speed", [1.2, -0.6])
def test_error_by_step_around_an_analytic_vortex(probe: Probe, report: Report, speed: float) -> None:
    """Water circles a vortex: after a time T it has turned by Ω(r) T, which is the truth. Fourth order in the step."""
    vortex = Vortex(place=(0.0, -30.0), radius=1.6, speed=speed)
    scene, seconds = alone(vortex), 16.0
    at = places(4000, 5.0)
    square = (at**2).sum(axis=1) / vortex.radius**2
    turned = -truth.angular_velocity(square, vortex.radius, vortex.speed) * seconds
    want = np.column_stack(
        (
            at[:, 0] * np.cos(turned) - at[:, 1] * np.sin(turned),
            at[:, 0] * np.sin(turned) + at[:, 1] * np.cos(turned),
        )
    )
    steps = (1.0, 0.5, 0.25, 0.125)
    errors = []
    for step in steps:
        count = round(seconds / step)
        body = f"vec2 q = x.xy; for (int i = 0; i < {count}; ++i) q = drift_back(q, {step}); y.xy = q;"
        errors.append(float(np.abs(shader(probe, scene, body, at)[:, :2] - want).max()))
    orders = [math.log2(a / b) for a, b in pairwise(errors)]
    report.add(
        "Water followed back 16 s around an analytic vortex (radius 1.6 m): greatest error by step",
        speed=f"{speed:g} m/s",
        **{f"{step:g} s": f"{1e3 * error:.3f} mm" for step, error in zip(steps, errors, strict=True)},
        orders=", ".join(f"{order:.1f}" for order in orders),
    )
    # Float32 ends the fall at some micrometres a step.
    assert all(order > 3.4 for order, error in zip(orders, errors[1:], strict=True) if error > 2e-4)
    assert errors[-1] < 5e-4
    # The reference's own step, in float64.
    own = np.column_stack(truth.flow_of(scene).back(*at.T, seconds))
    assert np.abs(own - want).max() < 2e-4


def test_patches_equal_float64(probe: Probe) -> None:
    at = places(20_000, 60.0)
    for generation in (0, 7, 1023):
        got = shader(probe, SCENE, f"y.x = drift_patch({generation}u, x.xy);", at)[:, 0]
        assert np.abs(got - truth.patch(SOURCE, generation, *at.T)).max() < 2e-4


@pytest.mark.parametrize("coverage", [0.05, 0.3, 0.6, 0.9])
def test_patches_cover_about_what_is_asked(report: Report, coverage: float) -> None:
    source = SOURCE.model_copy(update={"coverage": coverage})
    at = places(40_000, 300.0)
    mean = float(np.mean([truth.patch(source, generation, *at.T).mean() for generation in range(3)]))
    report.add("Share of the water that patches of one age cover", asked=f"{coverage:g}", found=f"{mean:.3f}")
    assert abs(mean - coverage) < 0.03


@pytest.mark.parametrize("origin", [(0.0, 0.0), (1e7, -1e7)], ids=str)
@pytest.mark.parametrize("time", [-1e9, 0.0, 12.5, 1e9 + 3.1])
def test_foam_equals_float64_at_any_time_and_place(
    probe: Probe, report: Report, time: float, origin: tuple[float, float]
) -> None:
    drift = SCENE.drift
    assert drift is not None
    moved = drift.model_copy(
        update={
            "place": (drift.place[0] * (origin[0] == 0.0) + origin[0], drift.place[1] * (origin[1] == 0.0) + origin[1]),
            "vortices": tuple(
                one.model_copy(
                    update={
                        "place": (
                            one.place[0] - drift.place[0] + (origin[0] or drift.place[0]),
                            one.place[1] - drift.place[1] + (origin[1] or drift.place[1]),
                        )
                    }
                )
                for one in drift.vortices
            ),
        }
    )
    far = SCENE.model_copy(update={"drift": moved})
    middle = np.array(moved.place) - np.array(origin)
    at = (places(5000, 20.0) + middle).astype(np.float32).astype(np.float64)
    got = shader(probe, far, f"y.x = drift_saturation(x.xy, 0.0, {FOOTPRINT});", at, time, origin)[:, 0]
    want = np.minimum(truth.drift_saturation(far, SOURCE, time, origin, *at.T), 4.0)
    away = np.abs(got - want)
    report.add(
        "Drifting foam against float64, 5 000 places, three vortices",
        time=f"{time:g} s",
        origin=f"{origin[0]:g} m",
        greatest=f"{away.max():.1e}",
        mean=f"{away.mean():.1e}",
    )
    assert want.std() > 0.1
    # Where ways part, micrometres of float32 grow by the stretch, and patches rise within decimetres.
    assert away.max() < 0.05
    assert away.mean() < 2e-4


def test_the_map_by_its_size_its_step_and_its_window(executor: Executor, report: Report) -> None:
    """Each texel against float64 at its middle: finer, shorter and longer are better."""
    time = 33.3

    def error(**parameters: object) -> float:
        quality = STANDARD.model_copy(update=parameters)
        found = drawn(executor, SCENE, quality, time)
        x, z = texels(quality.drift_size, 40.0)
        # About 2000 of them.
        kept = slice(None, None, max(7, 2 * (quality.drift_size // 64) ** 2 + 1))
        want = generations(SCENE, time, x[kept], z[kept])
        shares = np.sin(math.pi * (time % 5.0 + 5.0 * np.arange(4)) / 20.0) ** 2
        cut = min(math.ceil(quality.drift_window / 5.0), 4)
        got = found.reshape(-1, 4)[kept] * (np.arange(4) < cut)
        return float(np.sqrt(np.mean(((got - want) @ shares) ** 2)))

    sizes = {size: error(drift_size=size) for size in (64, 128, 256, 512)}
    steps = {step: error(drift_size=512, drift_step=step) for step in (4.0, 2.0, 1.0, 0.5)}
    turns = [given(SCENE, STANDARD.model_copy(update={"drift_step": step})).consts["DRIFT_STEPS"] for step in steps]
    windows = {window: error(drift_size=256, drift_window=window) for window in (5.0, 10.0, 15.0, 20.0)}
    for what, errors in (("texels", sizes), ("step, s", steps), ("window, s", windows)):
        report.add(
            "Map of drifting foam against float64, RMSE of the saturation",
            parameter=what,
            **{f"{i}": f"{value:g}: {found:.4f}" for i, (value, found) in enumerate(errors.items())},
        )
    assert all(b < a for a, b in pairwise(sizes.values()))
    # A vortex turns by a radian a step at most, whatever the parameter says: texels are what is left.
    assert turns == [7, 7, 7, 14]
    assert max(steps.values()) < 1.05 * min(steps.values())
    assert all(b < a for a, b in pairwise(windows.values()))
    assert sizes[512] < 0.06


def test_backward_is_one_everywhere_where_forward_gaps_and_piles(executor: Executor, report: Report) -> None:
    """Foam over all the water: carried by a flow without sources it stays 1, which points do not give."""
    source = SOURCE.model_copy(update={"coverage": 0.95, "patch": 500.0})
    scene = SCENE.model_copy(update={"foam": Foam(saturation=(source,))})
    inner = slice(32, 96)
    found: dict[str, Floats] = {}
    for ways in ("backward", "forward"):
        quality = STANDARD.model_copy(update={"drift": ways, "drift_size": 128})
        found[ways] = drawn(executor, scene, quality, 34.9)[inner, inner]
        if ways == "backward":
            # A generation of so large patches is nearly everywhere or nearly nowhere.
            full = np.flatnonzero(found[ways].mean(axis=(0, 1)) > 0.999)
            assert full.size > 0
        found[ways] = found[ways][..., full]
        report.add(
            "Full foam after a flow without sources, by the way it is mapped",
            ways=ways,
            empty=f"{100.0 * np.mean(found[ways] == 0.0):.1f} %",
            twice_or_more=f"{100.0 * np.mean(found[ways] >= 1.5):.1f} %",
            greatest=f"{found[ways].max():.0f}",
        )
    assert np.abs(found["backward"] - 1.0).max() < 1e-3
    assert np.mean(found["forward"] == 0.0) > 0.02
    assert np.mean(found["forward"] >= 1.5) > 0.005


def test_forward_foam_sticks_below_half_a_cell_a_step(executor: Executor) -> None:
    """Half a cell is 0.16 m here: 0.2 m/s in steps of 0.5 s leads nowhere, and what came up is still there."""
    quality = STANDARD.model_copy(update={"drift": "forward", "drift_size": 128, "drift_step": 0.5})
    slow = SCENE.model_copy(update={"drift": Drift(current=(0.2, 0.0), size=40.0)})
    assert (drawn(executor, slow, quality, 33.0) == drawn(executor, STILL, quality, 33.0)).all()
    backward = quality.model_copy(update={"drift": "backward"})
    assert (drawn(executor, slow, backward, 33.0) != drawn(executor, STILL, backward, 33.0)).any()


def test_nothing_jumps_when_a_generation_comes_up(probe: Probe) -> None:
    """The oldest has gone and the youngest has not begun: sin² is 0 at both ends, and 2 together at any time."""
    at = places(2000, 15.0) + np.array([0.0, -30.0])
    body = f"y.x = drift_saturation(x.xy, 0.0, {FOOTPRINT}); y.y = dot(drift_shares(), vec4(1.0));"
    for time in (5.0, -15.0, 5120.0, 1e9):
        before, after = (shader(probe, SCENE, body, at, time + way) for way in (-1e-4, 1e-4))
        assert np.abs(before[:, 1] - 2.0).max() < 1e-5
        assert np.abs(after - before).max() < 5e-3


def test_a_window_shorter_than_a_life_ends_smoothly(probe: Probe) -> None:
    at = places(500, 15.0) + np.array([0.0, -30.0])
    body = f"y.x = drift_saturation(x.xy, 0.0, {FOOTPRINT}); y.y = dot(drift_shares(), vec4(1.0));"
    cut = UNFILTERED.model_copy(update={"drift_window": 12.0})
    found = {
        name: [shader(probe, SCENE, body, at, time, quality=quality) for time in np.arange(0.0, 6.0, 0.05)]
        for name, quality in (("cut", cut), ("whole", UNFILTERED))
    }
    moved = {name: max(np.abs(b - a)[:, 0].max() for a, b in pairwise(frames)) for name, frames in found.items()}
    # What drifts by changes a place by itself; the window's end adds its slope, 0.5 a second.
    assert moved["cut"] < moved["whole"] + 0.05
    assert all(shares[:, 1].max() < 2.0 for shares in found["cut"])
    assert given(SCENE, cut).consts["DRIFT_GENERATIONS"] == 3


def test_waves_carry_as_far_as_their_orbits_do_not_close() -> None:
    """Water under a small wave, followed for a hundred periods: it goes on by a²ωk."""
    wave = ParametricWave(amplitude=0.1, wavelength=10.0, exponent=1.0, direction=0.7)
    scene = Scene(waves=(wave,), drift=Drift(current=(0.0, 0.0)))
    k = 2.0 * math.pi / wave.wavelength
    omega, a = math.sqrt(9.81 * k), 0.5 * wave.amplitude

    def velocity(x: float, y: float, t: float) -> tuple[float, float]:
        grown = a * omega * math.exp(k * y)
        return grown * math.cos(k * x - omega * t), grown * math.sin(k * x - omega * t)

    x, y, t, h = 0.0, a, 0.0, 2.0 * math.pi / omega / 64
    start = None
    for _ in range(64 * 100):
        u1 = velocity(x, y, t)
        u2 = velocity(x + 0.5 * h * u1[0], y + 0.5 * h * u1[1], t + 0.5 * h)
        u3 = velocity(x + 0.5 * h * u2[0], y + 0.5 * h * u2[1], t + 0.5 * h)
        u4 = velocity(x + h * u3[0], y + h * u3[1], t + h)
        x += h / 6.0 * (u1[0] + 2.0 * (u2[0] + u3[0]) + u4[0])
        y += h / 6.0 * (u1[1] + 2.0 * (u2[1] + u3[1]) + u4[1])
        t += h
        start = x if start is None else start
    assert start is not None
    drift = math.hypot(*stokes.steady_drift(scene))
    assert abs(math.atan2(*reversed(stokes.steady_drift(scene))) - 0.7) < 1e-12
    # A hundred periods of 2.5 s; the water swings by a around its mean.
    assert abs(x / t - drift) < 0.05 * drift


def test_a_sea_carries_about_a_hundredth_of_its_wind() -> None:
    """1 to 2 % of the wind at the surface of a full sea (Kenyon 1969), and less under a young one."""
    full = stokes.sea_drift(Sea(wind=10.0, fetch=1e6), None)
    assert 0.05 < full < 0.25
    assert stokes.sea_drift(Sea(wind=10.0, fetch=1e4), None) < full
    shallow = Scene(
        waves=(ParametricWave(wavelength=2000.0),), water=Water(depth=0.05), drift=Drift(current=(0.0, 0.0))
    )
    assert math.isfinite(math.hypot(*stokes.steady_drift(shallow)))


def test_a_vortex_that_grinds_all_is_refused_with_its_pointer() -> None:
    fast = SCENE.model_copy(update={"drift": Drift(vortices=(Vortex(radius=5.0), Vortex(radius=0.05, speed=20.0)))})
    with pytest.raises(PlanError) as caught:
        make_plan(fast, STANDARD)
    assert caught.value.pointer == "/drift/vortices/1/speed"


def test_without_drift_nothing_of_it_is_in_the_plan() -> None:
    for tier in TIERS.values():
        text = make_plan(Scene(foam=Foam()), tier).canonical_json().decode()
        assert "drift" not in text
        lone = make_plan(Scene(foam=Foam(saturation=(SOURCE,))), tier)
        assert {note.name for note in lone.skipped} >= {"drifting foam", "foam look"}
