"""Hard cases of waves.ripples, and scenes that call for it and cannot show it."""

from support.cases import Cases, HardCase
from support.hard.mutations import PLACE, TIME, TIME_AND_PLACE, guards
from support.scenes import Camera, Foam, Gusts, HeightSaturation, ParametricWave, Ripples, Scene, Water

_INVISIBLE = (
    Scene(water=Water(ripples=Ripples(slope=0.0))),
    Scene(water=Water(ripples=Ripples(slope=4e-7))),
    Scene(waves=(ParametricWave(),), foam=Foam(), water=Water(ripples=Ripples()), light=None),
)

_HARD = (
    HardCase(
        "ripples at any time",
        Scene(water=Water(ripples=Ripples())),
        guard="phases are reduced in float64 (framegraph/evaluation.py)",
        times=(-1e9, 0.0, 1e9, 1e9 + 1e-6),
        without=TIME,
    ),
    HardCase(
        "ripples ten thousand kilometres away",
        Scene(water=Water(ripples=Ripples())),
        guard="the camera's position in each tile is reduced in float64 (framegraph/evaluation.py)",
        camera=Camera(position=(-1e7, 1.2, 1e7), pitch=-0.3),
        without=PLACE,
    ),
    HardCase(
        "gusts anywhere, at any time",
        Scene(water=Water(ripples=Ripples(gusts=Gusts(strength=1.0, size=4.0, speed=20.0, change=0.5)))),
        guard="the camera's position in the noise is reduced in float64 (framegraph/evaluation.py)",
        times=(-1e9, 1e9),
        camera=Camera(position=(-1e7, 1.2, 1e7), yaw=1.0, pitch=-0.3),
        without=TIME_AND_PLACE,
    ),
    HardCase(
        "the steepest ripples, all one way",
        Scene(
            water=Water(ripples=Ripples(slope=0.6, spread=0.0)),
            foam=Foam(saturation=(HeightSaturation(base=-1.0, full=1.0),)),
        ),
        guard="the cosine of incidence is at least the roughness (light/shade.glsl@lit)",
        without={"light/shade.glsl": {"float cv = sqrt(nv * nv + sigma2 * aside2)": "float cv = nv"}},
        missed_by=guards("waves", "no_facet_that_faces_away_glitters"),
    ),
    HardCase(
        "ripples a million to a pixel",
        Scene(water=Water(ripples=Ripples(slope=0.6))),
        guard="exponents are limited to 75 (waves/ripples.glsl@bands)",
        camera=Camera(position=(0.0, 1e5, 0.0), pitch=-0.5, fov=2.6),
        unseen="not needed: exp of a large negative number is 0, as is what is left of a ripple",
    ),
)

CASES = {"ripples": Cases(invisible=_INVISIBLE, hard=_HARD)}
