"""Caustics, a level floor by the refracted ray, and the view from under the surface, against float64."""

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.planner import make_plan
from seafoam.quality import TIERS, Quality
from seafoam.reference.water import seafloor
from seafoam.render.gl.executor import Executor
from support.pictures import draw_target
from support.report import Report
from support.scenes import Caustics, Light, Ripples, Scene, Shore, Water

PLAIN = Light(sun_elevation=0.8, sun_azimuth=2.5, exposure=-1.5, caustics=Caustics(dispersion=0.0))
POOL = Scene(water=Water(depth=1.9, floor_tile=0.3, ripples=Ripples(slope=0.05, seed=3)), light=PLAIN)
TIME = 2.7
TEXELS = 256
Floats = NDArray[np.float64]


def light_of(executor: Executor, scene: Scene, quality: Quality = TIERS["standard"], **parameters: object) -> Floats:
    """The caustic map that a frame leaves, (texels, texels, 3), rows along z."""
    plan = make_plan(scene, quality.model_copy(update={"caustics_size": TEXELS, **parameters}))
    return draw_target(executor, plan, "caustics", TIME, scene.camera)[..., :3].astype(np.float64)


def means(light: Floats, over: int) -> Floats:
    """Means over squares of so many texels."""
    side = light.shape[0] // over
    return light.reshape(side, over, side, over, 3).mean(axis=(1, 3))


@dataclass(frozen=True)
class Way:
    """A way to draw caustics: its parameter, and by how much it may be off the trace at most of that."""

    kind: str
    parameter: str
    counts: tuple[int, ...]
    texels: int
    over: int
    """Texels of a side that are compared together."""
    error: float
    mean: float


# A triangle lights the texels whose centres it covers, so the grid's map is finer than what is compared.
WAYS = (
    Way("photons", "caustics_photons", (128, 256, 512), 256, 1, 0.01, 0.01),
    Way("grid", "caustics_cells", (64, 128, 256, 512), 1024, 8, 0.04, 0.02),
)


@pytest.mark.parametrize("way", WAYS, ids=lambda way: way.kind)
def test_grid_and_photons_converge_to_one_photon_trace(executor: Executor, report: Report, way: Way) -> None:
    """The mean difference of light from float64's trace of 2048² photons, mean light 1."""
    truth = means(seafloor.photon_map(POOL, TIME, way.texels, 2048), way.over)
    errors = []
    for count in way.counts:
        light = light_of(executor, POOL, caustics=way.kind, caustics_size=way.texels, **{way.parameter: count})
        errors.append(float(np.abs(means(light, way.over) - truth).mean()))
        assert abs(light.mean() - 1.0) <= way.mean
    assert errors == sorted(errors, reverse=True)
    report.within(
        "Caustics against a float64 trace of 2048² photons, mean difference over the mean light",
        way=way.kind,
        a_side=", ".join(map(str, way.counts)),
        over=f"{way.over * 9300 / way.texels:.0f} mm",
        error=", ".join(f"{100 * error:.2f} %" for error in errors),
        order=", ".join(f"{math.log2(a / b):.1f}" for a, b in pairwise(errors)),
        most=(errors[-1], way.error),
    )


@pytest.mark.parametrize(("parameter", "kind"), [("caustics_photons", "photons"), ("caustics_cells", "grid")])
def test_no_seam_shows(executor: Executor, kind: str, parameter: str) -> None:
    """Where the tile ends the map is as exact as elsewhere."""
    truth = seafloor.photon_map(POOL, TIME, TEXELS, 1024)
    away = np.abs(light_of(executor, POOL, caustics=kind, **{parameter: 256}) - truth).mean(axis=-1)
    rim = np.concatenate([away[:2], away[-2:], away[:, :2].T, away[:, -2:].T])
    assert rim.mean() <= 1.3 * away.mean()


def parted(dispersion: float) -> Scene:
    """The pool with colours apart."""
    return POOL.model_copy(update={"light": PLAIN.model_copy(update={"caustics": Caustics(dispersion=dispersion)})})


def test_colours_part_as_their_indices_do(executor: Executor) -> None:
    """With dispersion each colour is the map of its own index; without, all are one."""
    truth = seafloor.photon_map(parted(5.0), TIME, TEXELS, 512)
    assert np.abs(truth[..., 0] - truth[..., 2]).mean() > 0.1
    light = light_of(executor, parted(5.0), caustics="photons", caustics_photons=256)
    assert np.abs(light - truth).mean() <= 0.03
    same = light_of(executor, POOL)
    assert (same[..., 0] == same[..., 2]).all()


@pytest.mark.parametrize(("dispersion", "grids", "off"), [(1.0, 1, 0.3), (3.0, 1, 0.3), (6.0, 3, 0.35)])
def test_colours_by_grid_part_as_the_trace_has_them(
    executor: Executor, report: Report, dispersion: float, grids: int, off: float
) -> None:
    """One grid where colours land evenly beside one another, added up in one channel and moved for each; else three."""
    scene = parted(dispersion)
    plan = make_plan(scene, TIERS["standard"].model_copy(update={"caustics_size": TEXELS, "caustics_cells": 512}))
    assert sum(one.name.endswith(" light") for one in plan.passes) == grids
    assert plan.targets["caustic_light"].format == ("R16F" if grids == 1 else "RGBA16F")
    light, truth = light_of(executor, scene, caustics_cells=512), seafloor.photon_map(scene, TIME, TEXELS, 1024)
    apart, wide = (one[..., 0] - one[..., 2] for one in (light, truth))
    report.within(
        "Light of caustics by grid, and red less blue over what it is, against the trace",
        dispersion=dispersion,
        grids=grids,
        red_less_blue=(np.abs(apart - wide).mean() / np.abs(wide).mean(), off),
        light=(np.abs(light - truth).mean(), 0.06),
    )


def test_what_cannot_be_drawn_is_not_in_the_plan() -> None:
    """No ripples, no floor, a shore: caustics are asked for and there is nothing to draw."""
    light, ripples = Light(caustics=Caustics()), Ripples()
    for scene in (
        Scene(light=light, water=Water(depth=2.0)),
        Scene(light=light, water=Water(ripples=ripples)),
        Scene(light=light, water=Water(depth=2.0, ripples=ripples), shore=Shore()),
        Scene(light=None, water=Water(depth=2.0, floor_tile=0.3, ripples=ripples)),
    ):
        plan = make_plan(scene, TIERS["standard"])
        assert "caustics" not in {note.name for note in plan.effects} | set(plan.targets)
