"""Shadows of land against float64, and against rays to the sun (docs/formulae.md, section 8)."""

import numpy as np
import pytest

from seafoam.reference.light import light as sky
from seafoam.reference.shore.shore import land_shadow
from seafoam.render.gl.executor import Executor
from support.report import Report
from support.scenes import Light
from support.scenes.coasts import SEA, SHORE, coast, on_shore, places


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
