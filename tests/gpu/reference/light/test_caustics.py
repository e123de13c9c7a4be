"""Caustics, a level floor by the refracted ray, and the view from under the surface, against float64."""

import math
from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray
from pydantic import ValidationError

from seafoam.ocean.constants import WATER_INDEX
from seafoam.ocean.waves.ripples import REPEATING_TILES
from seafoam.planner import make_plan
from seafoam.quality import TIERS, Quality
from seafoam.reference.light.light import air
from seafoam.reference.water import seafloor
from seafoam.render.gl.executor import Executor
from support.pictures import draw_target
from support.report import Report
from support.scenes import Caustics, Light, Ripples, Scene, Shore, Water

PLAIN = Light(sun_elevation=0.8, sun_azimuth=2.5, exposure=-1.5, caustics=Caustics(dispersion=0.0))
POOL = Scene(water=Water(depth=1.9, floor_tile=0.3, ripples=Ripples(slope=0.05, seed=3)), light=PLAIN)
TIME = 2.7
TEXELS = 256


def drawn(executor: Executor, scene: Scene, quality: Quality, time: float = TIME) -> NDArray[np.float64]:
    """The caustic map that a frame leaves, (texels, texels, 3), rows along z."""
    drawn = draw_target(executor, make_plan(scene, quality), "caustics", time, scene.camera)
    return drawn[..., :3].astype(np.float64)


def wanted(**parameters: object) -> Quality:
    return TIERS["standard"].model_copy(update={"caustics_size": TEXELS, **parameters})


def orders(errors: list[float]) -> str:
    return ", ".join(f"{math.log2(a / b):.1f}" for a, b in pairwise(errors))


def means(light: NDArray[np.float64], over: int) -> NDArray[np.float64]:
    """Means over squares of so many texels."""
    side = light.shape[0] // over
    return light.reshape(side, over, side, over, 3).mean(axis=(1, 3))


@pytest.mark.parametrize(
    ("kind", "parameter", "counts", "texels", "over", "least", "most"),
    [
        ("photons", "caustics_photons", (128, 256, 512), 256, 1, 0.01, 0.01),
        # A triangle lights the texels whose centres it covers, so the grid's map is finer than what is compared.
        ("grid", "caustics_cells", (64, 128, 256, 512), 1024, 8, 0.04, 0.02),
    ],
)
def test_grid_and_photons_converge_to_one_photon_trace(
    executor: Executor,
    report: Report,
    kind: str,
    parameter: str,
    counts: tuple[int, ...],
    texels: int,
    over: int,
    least: float,
    most: float,
) -> None:
    """The mean difference of light from float64's trace of 2048² photons, mean light 1."""
    truth = means(seafloor.photon_map(POOL, TIME, texels, 2048), over)
    errors = []
    for count in counts:
        light = drawn(executor, POOL, wanted(caustics=kind, caustics_size=texels, **{parameter: count}))
        errors.append(float(np.abs(means(light, over) - truth).mean()))
        assert abs(light.mean() - 1.0) <= most
    report.add(
        "Caustics against a float64 trace of 2048² photons, mean difference over the mean light",
        way=kind,
        a_side=", ".join(map(str, counts)),
        over=f"{over * 9300 / texels:.0f} mm",
        error=", ".join(f"{100 * error:.2f} %" for error in errors),
        order=orders(errors),
    )
    assert errors == sorted(errors, reverse=True)
    assert errors[-1] <= least


@pytest.mark.parametrize(("parameter", "kind"), [("caustics_photons", "photons"), ("caustics_cells", "grid")])
def test_no_seam_shows(executor: Executor, kind: str, parameter: str) -> None:
    """Where the tile ends the map is as exact as elsewhere."""
    truth = seafloor.photon_map(POOL, TIME, TEXELS, 1024)
    away = np.abs(drawn(executor, POOL, wanted(caustics=kind, **{parameter: 256})) - truth).mean(axis=-1)
    rim = np.concatenate([away[:2], away[-2:], away[:, :2].T, away[:, -2:].T])
    assert rim.mean() <= 1.3 * away.mean()


def test_the_trace_itself_converges() -> None:
    """Photons of half as many a side: far below what is asked of shaders."""
    truth = seafloor.photon_map(POOL, TIME, 128, 1024)
    assert abs(truth.mean() - 1.0) <= 1e-6
    assert truth.max() > 2.5
    errors = [float(np.abs(seafloor.photon_map(POOL, TIME, 128, count) - truth).mean()) for count in (64, 128, 256)]
    assert errors[0] > 5.0 * errors[1] > 25.0 * errors[2]


def test_level_water_spreads_light_evenly() -> None:
    calm = POOL.model_copy(update={"water": POOL.water.model_copy(update={"ripples": Ripples(slope=0.0)})})
    assert np.abs(seafloor.photon_map(calm, 0.0, 64, 128) - 1.0).max() <= 1e-9


def test_rays_bend_by_snells_law() -> None:
    rng = np.random.default_rng(5)
    d, n = (v / np.linalg.norm(v, axis=1)[:, None] for v in rng.normal(size=(2, 4000, 3)))
    n *= -np.sign(np.einsum("ij,ij->i", d, n))[:, None]
    r = seafloor.refracted(d, n)
    assert np.abs(np.linalg.norm(r, axis=1) - 1.0).max() <= 1e-12
    assert np.abs(np.cross(d, n) - WATER_INDEX * np.cross(r, n)).max() <= 1e-12


def test_a_ray_lands_where_its_slope_sends_it() -> None:
    """Small slopes under a sun at the zenith: beside its entrance by depth × slope × (1 − 1/index), uphill."""
    zenith = air(Light(sun_elevation=math.pi / 2))
    slope = np.array([1e-4])
    x, z, share = seafloor.landing(zenith, 3.0, slope, np.zeros(1), WATER_INDEX)
    assert x[0] == pytest.approx(3.0 * 1e-4 * (1.0 - 1.0 / WATER_INDEX), rel=1e-6)
    assert abs(z[0]) <= 1e-12
    assert share[0] == pytest.approx(1.0)


def test_colours_part_as_their_indices_do(executor: Executor) -> None:
    """With dispersion each colour is the map of its own index; without, all are one."""
    apart = POOL.model_copy(update={"light": PLAIN.model_copy(update={"caustics": Caustics(dispersion=5.0)})})
    light = drawn(executor, apart, wanted(caustics="photons", caustics_photons=256))
    truth = seafloor.photon_map(apart, TIME, TEXELS, 512)
    assert np.abs(truth[..., 0] - truth[..., 2]).mean() > 0.1
    assert np.abs(light - truth).mean() <= 0.03
    same = drawn(executor, POOL, wanted())
    assert (same[..., 0] == same[..., 2]).all()


@pytest.mark.parametrize(("dispersion", "grids", "off"), [(1.0, 1, 0.3), (3.0, 3, 0.35)])
def test_colours_by_grid_part_as_the_trace_has_them(
    executor: Executor, report: Report, dispersion: float, grids: int, off: float
) -> None:
    """One grid where colours land evenly beside one another, moved for each; else a grid a colour."""
    apart = POOL.model_copy(update={"light": PLAIN.model_copy(update={"caustics": Caustics(dispersion=dispersion)})})
    quality = wanted(caustics_cells=512)
    names = [one.name for one in make_plan(apart, quality).passes if one.name.endswith(" light")]
    assert len(names) == grids
    light, truth = drawn(executor, apart, quality), seafloor.photon_map(apart, TIME, TEXELS, 1024)
    wide = np.abs(truth[..., 0] - truth[..., 2]).mean()
    error = np.abs((light[..., 0] - light[..., 2]) - (truth[..., 0] - truth[..., 2])).mean() / wide
    report.add(
        "Red less blue light of caustics by grid, against the trace",
        dispersion=f"{dispersion:g}",
        grids=f"{grids}",
        off=f"{100 * error:.0f} % of {wide:.3f}",
    )
    assert error <= off
    assert np.abs(light - truth).mean() <= 0.06


def test_ripples_repeat_with_their_light() -> None:
    long, short = REPEATING_TILES
    assert long / short == pytest.approx(3.0)
    plan = make_plan(POOL, TIERS["standard"])
    assert all(f"{tile:g} m tile" in " ".join(one.name for one in plan.passes) for tile in REPEATING_TILES)


def test_what_cannot_be_drawn_is_not_in_the_plan() -> None:
    """No ripples, no floor, a shore: caustics are asked for and there is nothing to draw."""
    light = Light(caustics=Caustics())
    for scene in (
        Scene(light=light, water=Water(depth=2.0)),
        Scene(light=light, water=Water(ripples=Ripples())),
        Scene(light=light, water=Water(depth=2.0, ripples=Ripples()), shore=Shore()),
        Scene(light=None, water=Water(depth=2.0, floor_tile=0.3, ripples=Ripples())),
    ):
        plan = make_plan(scene, TIERS["standard"])
        assert "caustics" not in {note.name for note in plan.effects}
        assert "caustics" not in plan.targets


@pytest.mark.parametrize(
    "part",
    [
        {"light": {"caustics": {"dispersion": 11.0}}},
        {"light": {"caustics": {"dispersion": -0.1}}},
        {"light": {"caustics": {"grid": 3}}},
        {"water": {"floor_tile": 0.0}},
    ],
    ids=str,
)
def test_out_of_range_is_refused(part: dict[str, object]) -> None:
    with pytest.raises(ValidationError):
        Scene.model_validate(part)
