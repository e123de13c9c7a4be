"""Shadows of clouds: GLSL against float64, their mean, and that they lie where the sky's clouds hide the lamp."""

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.effects.light.overcast import gap_light
from seafoam.reference.light import light as sky
from seafoam.render.gl.executor import Executor
from support.probe import shown
from support.report import Report
from support.scenes import Camera, Clouds, Light, Scene, Sky

EYE = (120.0, 10.0, -340.0)


def _scene(**fields: object) -> Scene:
    clouds = Clouds(size=1500.0, height=1200.0, thickness=8.0, seed=5, shadows=1.0).model_copy(update=fields)
    light = Light(sun_elevation=0.5, sun_azimuth=0.8, exposure=-2.0, sky=Sky(clouds=clouds))
    return Scene(light=light, camera=Camera(position=EYE))


def _truth(scene: Scene, place: NDArray[np.float64], side: float) -> NDArray[np.float64]:
    above = sky.air(scene.light, 3.0, EYE).above
    feet = np.tile((side, 0.0), (len(place), 1)), np.tile((0.0, 0.5 * side), (len(place), 1))
    return above.clouds.sunlight(place, feet)


def _places(far: float) -> NDArray[np.float64]:
    i = np.arange(1, 10_001)[:, None]
    p = (np.mod(i * np.array([0.754877666, 0.569840291]), 1.0) - 0.5) * far
    return np.stack((p[:, 0], np.full(len(p), 0.7), p[:, 1]), axis=-1)


@pytest.mark.parametrize("side", [0.1, 300.0, 2000.0])
def test_share_of_the_lamp(side: float, executor: Executor, report: Report) -> None:
    scene = _scene()
    fp = f"Footprint(vec2({side}, 0.0), vec2(0.0, {0.5 * side}))"
    body = f"o_color = vec4(sunlit(vec3(p.x, 0.7, p.y), {fp}), p, 0.0);"
    found = shown(executor, scene, body, 20000.0, time=3.0)
    place = np.stack((found[:, 1], np.full(len(found), 0.7), found[:, 2]), axis=-1)
    want = _truth(scene, place, side)
    off = np.abs(found[:, 0] - want)
    most = gap_light(scene.light.sky.clouds)
    assert found[:, 0].min() >= 0.0
    report.within(
        "Shadows of clouds, factor of the mean light of the lamp",
        footprint=f"{side} m",
        least=want.min(),
        most=(found[:, 0].max(), most * 1.0001),
        off=(np.quantile(off, 0.999), 2e-3),
    )


@pytest.mark.parametrize("side", [0.1, 300.0, 1000.0, 1e5])
@pytest.mark.parametrize("cover", [0.3, 0.6, 0.9])
def test_mean_is_kept(cover: float, side: float, report: Report) -> None:
    """Over many clouds the factor is 1 in the mean, whatever the footprint: energy is neither won nor lost."""
    scene = _scene(cover=cover)
    share = _truth(scene, _places(360.0 * 1500.0), side)
    report.add("Mean of the shadows of clouds", cover=f"{cover}", footprint=f"{side} m", mean=f"{share.mean():.3f}")
    assert share.mean() == pytest.approx(1.0, abs=0.03)
    if side > 1e4:
        assert share.std() < 1e-6


def test_shadow_lies_where_clouds_hide_the_lamp() -> None:
    """Seen from a place on the water, the lamp stands behind the cloud that shades the place."""
    hidden, share = [], []
    scene = _scene(softness=0.5, depth=0.0)
    for x in np.linspace(-20000.0, 20000.0, 60):
        eye = (float(x), 1.0, 0.4 * float(x))
        above = sky.air(scene.light, 3.0, eye).above
        lamp = above.lit_by[None, :]
        hidden.append(float(above.behind_clouds(np.zeros((1, 3)), lamp, (np.full(1, 2e-3), np.full(1, 2e-3)))[1][0]))
        none = np.zeros((1, 2))
        share.append(float(above.clouds.sunlight(np.array([[0.0, 1.0, 0.0]]), (none, none))[0]))
    shaded = np.array(share) * (1.0 - float(above.taken))
    assert np.corrcoef(1.0 - np.array(hidden), shaded)[0, 1] > 0.9
