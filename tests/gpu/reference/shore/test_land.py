"""Land in detail and its shadows against float64 (docs/formulae.md, section 8)."""

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.ocean.coast.rocks import splash_height
from seafoam.reference.light import light as sky
from seafoam.reference.shore import soil as truth
from seafoam.reference.shore.shore import land_shadow
from seafoam.render.gl.executor import Executor
from support.report import Report
from support.scenes import Light, Scene, load_preset
from support.scenes.coasts import SEA, SHORE, coast, on_shore, places

HIGH = SEA.model_copy(
    update={"shore": SHORE.model_copy(update={"height": 60.0, "slope": 0.5, "relief": 1.0, "plants_from": 3.0})}
)


class Ground:
    """The land of a scene with a shore at the places where shaders are evaluated."""

    def __init__(self, executor: Executor, scene: Scene) -> None:
        self.x, self.z = places(executor, scene)
        self.sea = coast(scene, 0.0)
        self.at = self.sea.place(self.x, self.z)
        self.height = self.sea.ground(*self.at)[0]


def _feet(side: float, count: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    return np.tile((side, 0.2 * side), (count, 1)), np.tile((-0.1 * side, 0.5 * side), (count, 1))


def _drawn(executor: Executor, scene: Scene, side: float, colour: str, name: str = "land") -> NDArray[np.float64]:
    """What ``colour`` is of ``q``, ``ground``, ``wet`` and ``soil`` under footprints of a side, m."""
    soil = "vec2 wet = land_wet(q, ground.x); Soil soil = land_soil(q, ground, fp, wet);" if name == "land" else ""
    body = f"Footprint fp = Footprint({side} * vec2(1.0, 0.2), {side} * vec2(-0.1, 0.5)); vec2 q = shore_place(p);"
    return on_shore(executor, scene, f"{body} vec4 ground = shore_floor(q); {soil} o_color = {colour};", name=name)


@pytest.mark.parametrize("side", [0.01, 0.3, 4.0])
def test_soil(side: float, executor: Executor, report: Report) -> None:
    of = Ground(executor, HIGH)
    dark, film = of.sea.wetness(*of.at, of.height)
    want = truth.detailed(of.sea.shore, of.at, of.sea.ground(*of.at), _feet(side, of.x.size), (dark, film))
    colour = _drawn(executor, HIGH, side, "vec4(soil.albedo, soil.film)")
    lean = _drawn(executor, HIGH, side, "vec4(soil.normal, 0.0)")[:, :3] - want.normal
    wet = _drawn(executor, HIGH, side, "vec4(wet, 0.0, 0.0)")[:, :2] - np.stack((dark, film), -1)
    land = of.height > 0.0

    def most(off: NDArray[np.float64]) -> float:
        return float(np.quantile(np.abs(off).reshape(land.size, -1).max(axis=1)[land], 0.99))

    assert want.albedo[land].std() > 0.02
    report.within(
        "Land's detail against float64, 99 % of the points on land",
        side=f"{side} m",
        albedo=(most(colour[:, :3] - want.albedo), 2e-3),
        normal=(most(lean), 5e-3),
        film=(most(colour[:, 3] - want.film), 2e-3),
        wetness=(most(wet), 1e-3),
    )


def test_rock_is_dark_where_spray_wets_it(executor: Executor, report: Report) -> None:
    """Of spray-on-rocks: up to the splash's height half as bright as dry, with a film; less so up to twice of it."""
    wet = load_preset("spray-on-rocks").scene.settled
    assert wet.shore is not None
    height, splash = Ground(executor, wet).height, splash_height(wet.shore, wet.spray)
    soaked, bare = (
        _drawn(executor, scene, 0.3, "vec4(soil.albedo, wet.x < 0.05 ? soil.film : -1.0)")
        for scene in (wet, wet.model_copy(update={"spray": None}))
    )
    share = soaked[:, 1] / np.maximum(bare[:, 1], 1e-6)
    never = (height > 0.02) & (soaked[:, 3] >= 0.0)
    low, middle, high = (
        never & (height > least * splash) & (height < most * splash)
        for least, most in ((0.0, 1.0), (1.4, 1.6), (1.7, 9.0))
    )
    shares = [float(share[part].mean()) for part in (low, middle, high)]
    report.add(
        "Wet rock over dry: below the splash, about 1.5 and over 1.7 of its height", got=str(np.round(shares, 3))
    )
    assert splash > 0.3
    assert share[low] == pytest.approx(0.5, abs=0.02)
    assert soaked[low, 3].mean() > bare[low, 3].mean() + 0.05
    assert shares[1] == pytest.approx(0.75, abs=0.05)
    assert shares[2] > 0.85


def test_what_the_footprint_hides_goes_over_into_its_mean(executor: Executor, report: Report) -> None:
    """Without detail in sight the mean colour stays: seen from afar land is as bright as the mean of what is near."""
    # Low land: of high land's layers of rock there are too few for a mean.
    low = HIGH.model_copy(update={"shore": SHORE.model_copy(update={"height": 30.0, "slope": 0.2, "relief": 0.6})})
    of = Ground(executor, low)
    place = tuple(part[of.height > 1.0] for part in of.at)
    count, ground = place[0].size, of.sea.ground(*place)
    near, *wide = (
        truth.detailed(of.sea.shore, place, ground, _feet(side, count), (np.zeros(count),) * 2).albedo.mean(axis=0)
        for side in (0.005, 0.5, 3.0, 8.0)
    )
    worst = max(float(np.abs(mean / near - 1.0).max()) for mean in wide)
    report.within("Mean reflectance of land under footprints of up to 8 m, of that of 5 mm", off=(worst, 0.04))


@pytest.mark.parametrize(("elevation", "azimuth"), [(0.08, 0.7), (0.25, -2.1), (0.6, 0.0)])
def test_share_of_the_sun(elevation: float, azimuth: float, executor: Executor, report: Report) -> None:
    shore = SHORE.model_copy(update={"shadows": True, "height": 40.0, "slope": 0.5, "relief": 0.5, "plants_from": 5.0})
    light = Light(sun_elevation=elevation, sun_azimuth=azimuth, exposure=-2.0)
    scene = SEA.model_copy(update={"shore": shore, "light": light})
    x, z = places(executor, scene)
    place = np.stack((x, np.full_like(x, 0.3), z), axis=-1)
    feet = np.tile((2.0, 0.5), (x.size, 1)), np.tile((-0.2, 1.0), (x.size, 1))
    body = "Footprint fp = Footprint(vec2(2.0, 0.5), vec2(-0.2, 1.0)); o_color.x = sunlit(vec3(p.x, 0.3, p.y), fp);"
    drawn = on_shore(executor, scene, body)[:, 0]
    land, sun = coast(scene, 0.0), sky.air(light).sun
    want = land_shadow(land, sun)(place, feet)
    # From a metre up toward the sun: nothing is met, or land.
    open_sky = land.crossing(x, place[:, 1], z, np.repeat(sun[None, :], x.size, axis=0), 1e4) >= 1e4
    above = land.ground(*land.place(x, z))[0] < 0.0
    assert drawn.min() >= 0.0
    assert drawn.max() <= 1.0
    assert 0.005 < 1.0 - open_sky[above].mean() < 0.9
    report.within(
        "Shadow of land over its water: off float64, and share where rays to the middle of the sun say otherwise",
        elevation=f"{elevation} rad",
        shaded=1.0 - open_sky[above].mean(),
        off=(np.quantile(np.abs(drawn - want)[above], 0.999), 0.02),
        otherwise=(((want > 0.5) != open_sky)[above].mean(), 0.01),
    )
