"""The planar mirror with land in it, against float64 rays from the water."""

import numpy as np
import pytest

from seafoam.planner import make_plan
from seafoam.reference import render
from seafoam.render.gl.executor import Executor
from support.exact import EXACT
from support.pictures import draw
from support.report import Report
from support.scenes import Boat, Camera, Clouds, Light, ParametricWave, Ripples, Scene, Shore, Sky, Surf, Water

SIZE = (128, 72)
TIME = 2.7
LAND = Shore(
    kind="lagoon", size=400.0, radius=90.0, depth=15.0, inner_depth=6.0, height=40.0, slope=0.4, surf=Surf(height=0.0)
)
STILL = Scene(
    shore=LAND,
    water=Water(scattering=0.012),
    light=Light(sun_elevation=0.4, exposure=-1.5, reflection="planar"),
    camera=Camera(position=(0.0, 1.8, 40.0), pitch=-0.05),
)
RIPPLED = STILL.model_copy(
    update={
        "waves": (ParametricWave(amplitude=0.02, wavelength=2.3, direction=1.1, exponent=1.0),),
        "water": Water(scattering=0.012, ripples=Ripples(slope=0.02)),
        "boats": (Boat(centre=(0.0, 0.0), radius=12.0, bearing=-1.5, speed=0.0, length=6.0),),
        "light": Light(exposure=-1.5, reflection="planar", sky=Sky(clouds=Clouds(cover=0.4))),
    }
)


@pytest.mark.parametrize(
    ("scene", "traced", "mapped"), [(STILL, 0.02, 2.0), (RIPPLED, 0.3, 4.0)], ids=["still water", "ripples and a boat"]
)
def test_land_in_the_mirror(executor: Executor, report: Report, scene: Scene, traced: float, mapped: float) -> None:
    """By rays from the water within ``traced`` levels, by the map within ``mapped``; far from the sky alone."""
    truth = np.clip(render(scene, time=TIME, width=SIZE[0], height=SIZE[1]).rgb, 0.0, 1.0)
    assert scene.light is not None
    alone = scene.model_copy(update={"light": scene.light.model_copy(update={"reflection": "sky"})})
    off = {}
    for name, one, parameters in (
        ("traced", scene, {}),
        ("map, 1024", scene, {"reflection": "map", "reflection_size": 1024}),
        ("map, 256", scene, {"reflection": "map", "reflection_size": 256}),
        ("sky alone", alone, {}),
    ):
        plan = make_plan(one, EXACT.model_copy(update=parameters))
        seen = draw(executor, plan, scene.camera, time=TIME, size=SIZE, output="samples")[..., :3]
        off[name] = 255.0 * float(np.sqrt(((np.clip(seen, 0.0, 1.0) - truth) ** 2).mean()))
    report.add(
        "Land in the planar mirror against float64, 128 × 72, RMSE in levels",
        water="still" if scene is STILL else "ripples",
        **{name: f"{value:.3f}" for name, value in off.items()},
    )
    assert off["traced"] <= traced
    assert off["map, 1024"] <= mapped
    assert off["sky alone"] >= 3.0 * off["map, 1024"]
