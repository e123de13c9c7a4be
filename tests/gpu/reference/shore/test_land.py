"""Land in detail against float64: noise and its slopes, colours, relief, wetness (docs/formulae.md, section 8)."""

import dataclasses

import numpy as np
import pytest
from numpy.typing import NDArray

from gpu.reference.shore.test_shore import places, probe
from seafoam.reference.shore import soil as truth
from seafoam.render.gl.executor import Executor
from support.exact import EXACT
from support.report import Report
from support.scenes import Scene
from support.scenes.coasts import SEA, SHORE, coast

HIGH = SEA.model_copy(
    update={"shore": SHORE.model_copy(update={"height": 60.0, "slope": 0.5, "relief": 1.0, "plants_from": 3.0})}
)


def _feet(side: float, count: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    return np.tile((side, 0.2 * side), (count, 1)), np.tile((-0.1 * side, 0.5 * side), (count, 1))


def _text(side: float) -> str:
    return f"Footprint fp = Footprint({side} * vec2(1.0, 0.2), {side} * vec2(-0.1, 0.5)); vec2 q = shore_place(p);"


@pytest.mark.parametrize("side", [0.01, 0.3, 4.0])
def test_soil(side: float, executor: Executor, report: Report) -> None:
    x, z = places(executor, HIGH)
    sea = coast(HIGH, 0.0)
    q_x, q_z = sea.place(x, z)
    height = sea.ground(q_x, q_z)[0]
    feet = _feet(side, x.size)
    dark, film = sea.wetness(q_x, q_z, height)
    want = truth.detailed(sea.shore, (q_x, q_z), sea.ground(q_x, q_z), feet, (dark, film))
    body = _text(side) + "vec4 ground = shore_floor(q); Soil soil = land_soil(q, ground, fp, land_wet(q, ground.x));"
    colour = probe(executor, HIGH, body + "o_color = vec4(soil.albedo, soil.film);", name="land")
    relief = probe(executor, HIGH, body + "o_color = vec4(soil.normal, 0.0);", name="land")[:, :3]
    wet = probe(executor, HIGH, _text(side) + "o_color = vec4(land_wet(q, shore_floor(q).x), 0.0, 0.0);", name="land")
    land = height > 0.0
    tint = np.abs(colour[:, :3] - want.albedo).max(axis=1)[land]
    lean = np.abs(relief - want.normal).max(axis=1)[land]
    shine = np.abs(colour[:, 3] - want.film)[land]
    soaked = np.abs(wet[:, :2] - np.stack((dark, film), -1)).max(axis=1)[land]
    report.add(
        "Land's detail against float64, 99 % of the points on land",
        side=f"{side} m",
        **{
            name: f"{np.quantile(off, 0.99):.1e}"
            for name, off in (("albedo", tint), ("normal", lean), ("film", shine), ("wetness", soaked))
        },
    )
    assert want.albedo[land].std() > 0.02
    assert np.quantile(tint, 0.99) <= 2e-3
    assert np.quantile(lean, 0.99) <= 5e-3
    assert np.quantile(shine, 0.99) <= 2e-3
    assert np.quantile(soaked, 0.99) <= 1e-3


def test_sand_goes_on_under_the_waters_edge(executor: Executor) -> None:
    """The floor's colour there is that of soaked land in detail; the shader's is the truth's at all depths."""
    x, z = places(executor, HIGH)
    sea = coast(HIGH, 0.0)
    q_x, q_z = sea.place(x, z)
    height = sea.ground(q_x, q_z)[0]
    feet = _feet(0.05, x.size)
    down, up = np.tile((0.0, -1.0, 0.0), (x.size, 1)), np.tile((0.0, 1.0, 0.0), (x.size, 1))
    want = sea.bed(x, z, height + 1e-3, down, up, feet).albedo
    body = _text(0.05) + "o_color = vec4(floor_albedo(q, shore_floor(q), fp), 0.0);"
    got = probe(executor, HIGH, body)[:, :3]
    assert np.quantile(np.abs(got - want), 0.99) <= 2e-3
    wet = np.ones_like(x), np.ones_like(x)
    soaked = truth.detailed(sea.shore, (q_x, q_z), sea.ground(q_x, q_z), feet, wet, floor=True).albedo
    edge = (height > -0.1) & (height < 0.5)
    assert np.count_nonzero(edge) > 50
    np.testing.assert_allclose(want[edge], soaked[edge], atol=1e-9)
    deep = height < -0.6
    assert np.abs(want - soaked)[deep].mean() > 0.005


def test_wetness_is_the_last_swashs(executor: Executor) -> None:
    """It falls from wave to wave as the time since the crest grows, and the next crest renews it."""
    assert SEA.shore is not None
    period = SEA.shore.surf.period
    sea = [coast(SEA, time) for time in (0.0, 0.02 * period)]
    x, z = places(executor, SEA)
    q_x, q_z = sea[0].place(x, z)
    height = sea[0].ground(q_x, q_z)[0]
    swash = 0.3 * SEA.shore.surf.height
    turn = sea[0].turn(sea[0].field.value(q_x, q_z)[:, 0])
    inside = (height > 0.3 * swash) & (height < swash)
    ages = 1.0 - turn
    films = [one.wetness(q_x, q_z, height)[1] for one in sea]
    drying = inside & (ages < 0.95) & (films[0] > 0.05)
    assert np.count_nonzero(drying) > 20
    assert (films[1] <= films[0] + 0.02)[drying].all()


def test_what_the_footprint_hides_goes_over_into_its_mean(executor: Executor, report: Report) -> None:
    """Without detail in sight the mean colour stays: seen from afar land is as bright as the mean of what is near."""
    # Low land: of high land's layers of rock there are too few for a mean.
    low = HIGH.model_copy(update={"shore": SHORE.model_copy(update={"height": 30.0, "slope": 0.2, "relief": 0.6})})
    x, z = places(executor, low)
    sea = coast(low, 0.0)
    q_x, q_z = sea.place(x, z)
    height = sea.ground(q_x, q_z)[0]
    land = height > 1.0
    place, dry = (q_x[land], q_z[land]), (np.zeros(int(land.sum())), np.zeros(int(land.sum())))
    ground = sea.ground(*place)
    means = {
        side: truth.detailed(sea.shore, place, ground, _feet(side, int(land.sum())), dry).albedo.mean(axis=0)
        for side in (0.005, 0.5, 3.0, 8.0)
    }
    shown = {f"{side} m": ", ".join(f"{c:.4f}" for c in mean) for side, mean in means.items()}
    report.add("Mean reflectance of land under footprints", **shown)
    for side, mean in means.items():
        assert np.abs(mean / means[0.005] - 1.0).max() <= 0.04, side


def test_slopes_are_those_of_the_noise() -> None:
    random = np.random.default_rng(3)
    x, z = random.uniform(-500.0, 500.0, (2, 20_000))
    step = 1e-5
    value, along_x, along_z = truth.slopes(7, x, z)
    assert abs(value.std() - 1.0) <= 0.02
    assert abs(value.mean()) <= 0.03
    for a, b, got in ((step, 0.0, along_x), (0.0, step, along_z)):
        change = (truth.slopes(7, x + a, z + b)[0] - truth.slopes(7, x - a, z - b)[0]) / (2.0 * step)
        assert np.abs(change - got).max() <= 1e-4


def test_no_detail_is_the_smooth_land(executor: Executor) -> None:
    assert HIGH.shore is not None
    plain = HIGH.model_copy(update={"shore": HIGH.shore.model_copy(update={"detail": 0.0})})
    x, z = places(executor, plain)
    sea = coast(plain, 0.0)
    q_x, q_z = sea.place(x, z)
    want = sea.soil(q_x, q_z, _feet(0.3, x.size), still=False)
    body = _text(0.3) + "vec4 ground = shore_floor(q); Soil soil = land_soil(q, ground, fp, land_wet(q, ground.x));"
    colour = probe(executor, plain, body + "o_color = vec4(soil.albedo, soil.film);", name="land")
    assert np.quantile(np.abs(colour[:, :3] - want.albedo), 0.99) <= 1e-3
    assert np.quantile(np.abs(colour[:, 3] - want.film), 0.99) <= 1e-3
    assert dataclasses.replace(want).glints is False


def test_a_scene_without_land_in_detail_has_no_octaves() -> None:
    from seafoam.planner import make_plan

    assert SEA.shore is not None
    plain = SEA.model_copy(update={"shore": SEA.shore.model_copy(update={"detail": 0.0})})
    for scene, there in ((SEA, True), (plain, False), (Scene(), False)):
        text = "".join(one.fragment.text for one in make_plan(scene, EXACT).programs.values())
        assert ("noise_slopes" in text) is there
