"""The planar mirror, of boats and of land, against float64 rays from the water."""

import pytest

from seafoam.reference import render
from seafoam.render.gl.executor import Executor
from support.exact import EXACT
from support.pictures import rmse, samples
from support.report import Report
from support.scenes import Boat, Camera, Clouds, Light, ParametricWave, Ripples, Scene, Shore, Sky, Surf, Water

SIZE = (128, 72)
TIME = 2.7
LAND = Scene(
    shore=Shore(
        kind="lagoon",
        size=400.0,
        radius=90.0,
        depth=15.0,
        inner_depth=6.0,
        height=40.0,
        slope=0.4,
        surf=Surf(height=0.0),
    ),
    water=Water(scattering=0.012),
    light=Light(sun_elevation=0.4, exposure=-1.5, reflection="planar"),
    camera=Camera(position=(0.0, 1.8, 40.0), pitch=-0.05),
)
RIPPLED = LAND.model_copy(
    update={
        "waves": (ParametricWave(amplitude=0.02, wavelength=2.3, direction=1.1, exponent=1.0),),
        "water": Water(scattering=0.012, ripples=Ripples(slope=0.02)),
        "boats": (Boat(centre=(0.0, 0.0), radius=12.0, bearing=-1.5, speed=0.0, length=6.0),),
        "light": Light(exposure=-1.5, reflection="planar", sky=Sky(clouds=Clouds(cover=0.4))),
    }
)
BOATS = Scene(
    boats=(
        Boat(centre=(0.0, -40.0), radius=20.0, bearing=1.7, speed=0.0, heel=0.15),
        Boat(centre=(-30.0, -30.0), radius=20.0, bearing=0.3, speed=0.0, kind="motor", length=11.0),
    ),
    light=Light(reflection="planar", sun_elevation=0.5, sun_azimuth=2.4, exposure=-1.2),
    camera=Camera(position=(0.0, 3.0, 0.0), pitch=-0.12, fov=0.7),
)
WAVY = BOATS.model_copy(
    update={
        "waves": (ParametricWave(amplitude=0.12, wavelength=5.0, direction=1.1),),
        "camera": BOATS.camera.model_copy(update={"position": (0.0, 3.1, 0.0)}),
    }
)


@pytest.mark.whole
@pytest.mark.parametrize(
    ("scene", "traced", "mapped", "better"),
    [(LAND, 0.02, 2.0, 3.0), (RIPPLED, 0.3, 4.0, 3.0), (WAVY, 1.5, 9.0, 1.66)],
    ids=["land in still water", "land and a boat in ripples", "boats in waves"],
)
def test_what_stands_by_the_water_is_in_the_mirror(
    executor: Executor, report: Report, scene: Scene, traced: float, mapped: float, better: float
) -> None:
    """By rays from the water within ``traced`` levels, by the map within ``mapped``; the sky alone is far from it.

    On waves the map knows only what the mirrored eye sees.
    """
    truth = render(scene, time=TIME, width=SIZE[0], height=SIZE[1]).rgb

    def off(scene: Scene, **parameters: object) -> float:
        return rmse(samples(executor, scene, EXACT.model_copy(update=parameters), time=TIME, size=SIZE), truth)

    alone = scene.model_copy(update={"light": scene.light.model_copy(update={"reflection": "sky"})})
    by_map, sky = off(scene, reflection="map", reflection_size=1024), off(alone)
    report.within(
        "The planar mirror against float64, 128 × 72, RMSE in levels",
        boats=len(scene.boats),
        waves=len(scene.waves),
        traced=(off(scene), traced),
        map_of_1024=(by_map, mapped),
        of_256=off(scene, reflection="map", reflection_size=256),
        sky_alone=sky,
    )
    assert sky >= better * by_map
