"""Drifting foam: the shader's flow, ways and patches against float64, an analytic vortex by step, maps both ways."""

import math
from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from seafoam.effects.effect import Contribution, PlanError
from seafoam.effects.foam import drift as effect
from seafoam.ocean.waves import stokes
from seafoam.planner import make_plan
from seafoam.quality import TIERS, Quality
from seafoam.reference.foam import drift as truth
from seafoam.render.gl.executor import Executor
from support.exact import UNFILTERED
from support.pictures import draw_target, rms
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
SUM = f"y.x = drift_saturation(x.xy, 0.0, {FOOTPRINT}); y.y = dot(drift_shares(), vec4(1.0));"
SCENE = Scene(
    drift=Drift(current=(0.35, -0.1), size=40.0, vortices=EDDIES), foam=Foam(saturation=(SOURCE,), look="halftone")
)


def drifting(**fields: object) -> Scene:
    """The scene with another drift, on a square of 40 m."""
    return SCENE.model_copy(update={"drift": Drift(size=40.0, **fields)})


def given(scene: Scene, quality: Quality) -> Contribution:
    return effect.EFFECT.contribute(scene, quality)


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


def test_error_by_step_around_an_analytic_vortex(probe: Probe, report: Report) -> None:
    """Water circles a vortex: after a time T it has turned by Ω(r) T, which is the truth. Fourth order in the step."""
    vortex = Vortex(place=(0.0, -30.0), radius=1.6, speed=1.2)
    scene, seconds = drifting(place=vortex.place, current=(0.0, 0.0), vortices=(vortex,)), 16.0
    at = places(4000, 5.0)
    turned = -truth.angular_velocity((at**2).sum(axis=1) / vortex.radius**2, vortex.radius, vortex.speed) * seconds
    moved = (at[:, 0] + 1j * at[:, 1]) * np.exp(1j * turned)
    want = np.column_stack((moved.real, moved.imag))
    steps = (1.0, 0.5, 0.25, 0.125)
    errors = []
    for step in steps:
        count = round(seconds / step)
        body = f"vec2 q = x.xy; for (int i = 0; i < {count}; ++i) q = drift_back(q, {step}); y.xy = q;"
        errors.append(float(np.abs(shader(probe, scene, body, at)[:, :2] - want).max()))
    orders = [math.log2(a / b) for a, b in pairwise(errors)]
    # Float32 ends the fall at some micrometres a step.
    assert all(order > 3.4 for order, error in zip(orders, errors[1:], strict=True) if error > 2e-4)
    own = np.column_stack(truth.flow_of(scene).back(*at.T, seconds))
    report.within(
        "Water followed back 16 s around an analytic vortex (radius 1.6 m): greatest error in steps of 1/8 s, m",
        orders=", ".join(f"{order:.1f}" for order in orders),
        error=(errors[-1], 5e-4),
        references_own_step=(np.abs(own - want).max(), 2e-4),
    )


@pytest.mark.parametrize("origin", [(0.0, 0.0), (1e7, -1e7)], ids=str)
@pytest.mark.parametrize("time", [-1e9, 0.0, 12.5, 1e9 + 3.1])
def test_foam_equals_float64_at_any_time_and_place(
    probe: Probe, report: Report, time: float, origin: tuple[float, float]
) -> None:
    drift = SCENE.drift
    middle = origin if origin[0] else drift.place

    def there(place: tuple[float, float]) -> tuple[float, float]:
        return place[0] - drift.place[0] + middle[0], place[1] - drift.place[1] + middle[1]

    vortices = tuple(one.model_copy(update={"place": there(one.place)}) for one in drift.vortices)
    far = SCENE.model_copy(update={"drift": drift.model_copy(update={"place": middle, "vortices": vortices})})
    at = (places(5000, 20.0) + np.array(middle) - np.array(origin)).astype(np.float32).astype(np.float64)
    got = shader(probe, far, SUM, at, time, origin)[:, 0]
    want = np.minimum(truth.drift_saturation(far, SOURCE, time, origin, *at.T), 4.0)
    away = np.abs(got - want)
    assert want.std() > 0.1
    # Where ways part, micrometres of float32 grow by the stretch, and patches rise within decimetres.
    report.within(
        "Drifting foam against float64, 5 000 places, three vortices",
        time=time,
        origin=origin[0],
        greatest=(away.max(), 0.05),
        mean=(away.mean(), 2e-4),
    )


def test_the_map_by_its_size_its_step_and_its_window(executor: Executor, report: Report) -> None:
    """Each texel against float64 at its middle: finer, shorter and longer are better."""
    time = 33.3

    @cache
    def wanted(size: int) -> tuple[slice, Floats]:
        """About 2000 of the texels, and their generations."""
        kept = slice(None, None, max(7, 2 * (size // 64) ** 2 + 1))
        x, z = texels(size, 40.0)
        return kept, generations(SCENE, time, x[kept], z[kept])

    def error(**parameters: object) -> float:
        quality = STANDARD.model_copy(update=parameters)
        found, (kept, want) = drawn(executor, SCENE, quality, time), wanted(quality.drift_size)
        shares = np.sin(math.pi * (time % 5.0 + 5.0 * np.arange(4)) / 20.0) ** 2
        cut = min(math.ceil(quality.drift_window / 5.0), 4)
        return rms((found.reshape(-1, 4)[kept] * (np.arange(4) < cut) - want) @ shares)

    sizes = [error(drift_size=size) for size in (64, 128, 256, 512)]
    steps = [error(drift_size=512, drift_step=step) for step in (4.0, 2.0, 1.0, 0.5)]
    windows = [error(drift_size=256, drift_window=window) for window in (5.0, 10.0, 15.0, 20.0)]
    for what, errors in (("64 to 512 texels", sizes), ("steps of 4 to 0.5 s", steps), ("5 to 20 s", windows)):
        found = " ".join(f"{one:.4f}" for one in errors)
        report.add("Map of drifting foam against float64, RMSE of the saturation", by=what, error=found)
    assert all(b < a for errors in (sizes, windows) for a, b in pairwise(errors))
    # A vortex turns by a radian a step at most, whatever the parameter says: texels are what is left.
    shorter = [STANDARD.model_copy(update={"drift_step": step}) for step in (4.0, 2.0, 1.0, 0.5)]
    assert [given(SCENE, quality).consts["DRIFT_STEPS"] for quality in shorter] == [7, 7, 7, 14]
    assert max(steps) < 1.05 * min(steps)
    assert sizes[-1] < 0.06


def test_backward_is_one_everywhere_where_forward_gaps_and_piles(executor: Executor, report: Report) -> None:
    """Foam over all the water: carried by a flow without sources it stays 1, which points do not give."""
    source = SOURCE.model_copy(update={"coverage": 0.95, "patch": 500.0})
    scene = SCENE.model_copy(update={"foam": Foam(saturation=(source,))})
    inner = slice(32, 96)
    backward, forward = (
        drawn(executor, scene, STANDARD.model_copy(update={"drift": way, "drift_size": 128}), 34.9)[inner, inner]
        for way in ("backward", "forward")
    )
    # A generation of so large patches is nearly everywhere or nearly nowhere.
    full = np.flatnonzero(backward.mean(axis=(0, 1)) > 0.999)
    assert full.size > 0
    backward, forward = backward[..., full], forward[..., full]
    empty, twice = float(np.mean(forward == 0.0)), float(np.mean(forward >= 1.5))
    report.within(
        "Full foam after a flow without sources, by the way it is mapped",
        forward=f"{100.0 * empty:.1f} % empty, {100.0 * twice:.1f} % twice or more, at most {forward.max():.0f}",
        backward=(np.abs(backward - 1.0).max(), 1e-3),
    )
    assert empty > 0.02
    assert twice > 0.005


def test_waves_carry_as_far_as_their_orbits_do_not_close() -> None:
    """Water under a small wave, followed for a hundred periods: it goes on by a²ωk."""
    wave = ParametricWave(amplitude=0.1, wavelength=10.0, exponent=1.0, direction=0.7)
    scene = Scene(waves=(wave,), drift=Drift(current=(0.0, 0.0)))
    k = 2.0 * math.pi / wave.wavelength
    omega, a = math.sqrt(9.81 * k), 0.5 * wave.amplitude

    def velocity(t: float, place: NDArray[np.float64]) -> NDArray[np.float64]:
        x, y = place
        turn = k * x - omega * t
        return a * omega * math.exp(k * y) * np.array([math.cos(turn), math.sin(turn)])

    end = 200.0 * math.pi / omega
    x = solve_ivp(velocity, (0.0, end), (0.0, a), rtol=1e-8, atol=1e-8).y[0, -1]
    u, w = stokes.steady_drift(scene)
    assert abs(math.atan2(w, u) - 0.7) < 1e-12
    # A hundred periods of 2.5 s; the water swings by a around its mean.
    assert x / end == pytest.approx(math.hypot(u, w), rel=0.05)


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
