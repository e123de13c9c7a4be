"""What an eye under the surface sees: the underside, floor, hulls and the water between, against float64."""

import numpy as np
import pytest

from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.reference import render
from seafoam.render.gl.executor import Executor
from support.exact import EXACT
from support.pictures import draw, levels, samples
from support.report import Report
from support.scenes import (
    Boat,
    Camera,
    Caustics,
    Clouds,
    Foam,
    HeightSaturation,
    Light,
    ParametricWave,
    Ripples,
    Scene,
    Sea,
    Shore,
    Sky,
    SlopeSaturation,
    Surf,
    SurfSaturation,
    Water,
)

PLAIN = Light(sun_elevation=0.8, sun_azimuth=2.5, exposure=-1.5, caustics=Caustics(dispersion=0.0))
POOL = Scene(water=Water(depth=1.9, floor_tile=0.3, ripples=Ripples(slope=0.05, seed=3)), light=PLAIN)
TIME = 2.7

WAVES = (ParametricWave(amplitude=0.5, wavelength=6.0, phase=1.0), ParametricWave(amplitude=0.2, wavelength=2.9))
BEACH = Scene(
    shore=Shore(size=160.0, radius=25.0, depth=6.0, slope=0.1, smoothing=3.0, surf=Surf(height=0.8)),
    water=Water(scattering=0.01),
    foam=Foam(saturation=(SurfSaturation(),), look="halftone", mask="clump"),
    light=Light(sun_elevation=0.7, sun_azimuth=2.0, exposure=-2.0),
)
VIEWS = {
    "up, across the critical angle": (POOL, Camera(position=(0.3, -1.1, 0.2), pitch=0.5)),
    "under waves with foam, no floor": (
        Scene(
            waves=WAVES,
            water=Water(ripples=Ripples()),
            foam=Foam(saturation=(SlopeSaturation(),), look="textured"),
            light=Light(exposure=-1.0),
        ),
        Camera(position=(0.0, -2.0, 0.0), pitch=0.4, yaw=1.0),
    ),
    "in a crest over a floor": (
        Scene(waves=WAVES, water=Water(depth=1.26, floor_tile=0.5), light=Light(exposure=-1.5)),
        Camera(position=(0.0, -0.11, 0.0), pitch=0.1),
    ),
    "before a beach": (BEACH, Camera(position=(-42.0, -1.2, 9.0), yaw=1.4, pitch=0.1)),
    "under a boat": (
        Scene(
            waves=WAVES[:1],
            boats=(Boat(centre=(0.0, -14.0), radius=15.0, bearing=1.5, speed=0.0),),
            water=Water(ripples=Ripples()),
            light=Light(exposure=-1.0),
        ),
        Camera(position=(-2.0, -1.5, 10.0), yaw=0.2, pitch=0.15),
    ),
    "under an open sea": (
        Scene(sea=Sea(wind=7.0), light=Light(exposure=-1.0)),
        Camera(position=(0.0, -1.5, 0.0), pitch=0.6),
    ),
    "under clouds": (
        Scene(light=Light(sky=Sky(clouds=Clouds(cover=0.5)), exposure=-1.5), water=Water(ripples=Ripples())),
        Camera(position=(0.0, -1.0, 0.0), pitch=1.2),
    ),
    "foam without light": (
        Scene(waves=WAVES, light=None, foam=Foam(saturation=(HeightSaturation(base=0.1, full=0.7),), look="textured")),
        Camera(position=(0.0, -0.5, 0.0), pitch=0.5),
    ),
}


@pytest.mark.parametrize("view", VIEWS)
def test_views_equal_float64(executor: Executor, report: Report, view: str) -> None:
    scene, camera = VIEWS[view]
    got = samples(executor, scene, EXACT, camera, time=TIME, size=(96, 54))
    want = render(scene, time=TIME, width=96, height=54, camera=camera).rgb
    away = levels(got, want)
    report.within(
        "Floor and view from below against float64, 96 × 54, levels of linear light",
        view=view,
        mean=(away.mean(), 0.5),
        over_2=((away > 2.0).mean(), 0.02),
    )


def test_plans_say_which_program_an_eye_needs(executor: Executor) -> None:
    """Over all crests the programs of an eye in the air, under all troughs those of one under water; between, both."""
    scene = Scene(waves=WAVES, water=Water(ripples=Ripples()), boats=(Boat(),))
    plan = make_plan(scene, TIERS["standard"])
    assert plan.top >= 0.43
    for eye, count in (("over", 1), ("between", 2), ("under", 1)):
        sided = [one for one in plan.passes if one.eye != "any" and eye in one.eye]
        assert sorted(one.name for one in sided) == sorted(count * ["surface samples", "surface", "boats"])
        # What the passes of one side have drawn, those of the other leave.
        shown = [one.state.clear for one in sided if one.target != "surface samples"]
        assert shown == [True, *(count - 1) * [False]] * 2
    high = Camera(position=(0.0, plan.top, 0.0), pitch=-0.2)
    anyway = plan.model_copy(update={"top": plan.top + 1.0})
    frames = [draw(executor, one, high, time=TIME, size=(96, 54), output="linear") for one in (plan, anyway)]
    np.testing.assert_array_equal(*frames)
