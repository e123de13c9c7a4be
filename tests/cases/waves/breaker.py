"""Test scenes of plunging crests: hard cases, and scenes that name one but cannot show it."""

from seafoam.ocean.waves.plunging import overturning
from support.cases import Cases, HardCase, reduced
from support.scenes import Breaker, BreakerSaturation, Camera, Foam, HeightSaturation, Light, Ripples, Scene, Sky, Water

CREST = Breaker(place=(-16.0, -24.0), heading=0.0, height=2.0, length=40.0, peel_angle=0.8)
"""Seen from :data:`EYE` it overturns after 2 s."""
LEFT = Foam(saturation=(BreakerSaturation(),), mask="clump")
FOAM = Foam(saturation=(HeightSaturation(base=20.0, full=21.0),), octaves=1)
PLUNGING = Scene(breaker=CREST, foam=FOAM, light=Light(sun_azimuth=3.8, sun_elevation=0.3, exposure=-1.3))
EYE = Camera(position=(7.0, 1.4, 2.0), yaw=-0.5, fov=0.8)
_FORM = overturning(CREST)
_EVERY = _FORM.period / _FORM.rate

_HARD = (
    HardCase(
        "an eye in the crest",
        PLUNGING,
        guard="from in the crest nothing of it is seen (waves/breaker.glsl@trace)",
        times=(2.0,),
        camera=Camera(position=(-3.2, 0.8, -8.0), yaw=-0.5),
        without={"waves/breaker.glsl": {"span.x > 0.0 || crest_gap(there, CREST_WHOLE) >= 0.0": "true"}},
    ),
    HardCase(
        "a lip that is thinner than a step",
        PLUNGING,
        guard="the jet's top and underside are looked for where both ends of a step are in the air "
        "(waves/breaker.glsl@trace)",
        times=(2.3,),
        camera=EYE,
        without={"waves/breaker.glsl": {"for (int i = 2; i >= 0; --i)": "for (int i = 2; i >= 2; --i)"}},
    ),
    HardCase(
        "crests that hide one another",
        PLUNGING.model_copy(update={"breaker": CREST.model_copy(update={"every": 3.0})}),
        guard="of several crests the nearest is seen (waves/breaker.glsl@main)",
        times=(6.0,),
        camera=Camera(position=(-40.0, 4.0, -12.0), yaw=1.4, pitch=-0.1),
        without={"waves/breaker.glsl": {" && way < t": ""}},
    ),
    reduced(
        "a crest ten thousand kilometres away, after thirty years",
        PLUNGING.model_copy(update={"breaker": CREST.model_copy(update={"place": (9999973.0, -9999976.0)})}),
        "where the crest is vertical, and the vector from where it begins",
        Camera(position=(9999996.0, 1.4, -9999950.0), yaw=-0.5, fov=0.8),
        tuple(2.3 + _EVERY * round(time / _EVERY) for time in (-1e9, 1e9)),
    ),
)

_VARIANTS = (
    PLUNGING.model_copy(update={"light": None}),
    PLUNGING.model_copy(update={"foam": LEFT, "light": None}),
    PLUNGING.model_copy(update={"foam": LEFT.model_copy(update={"look": "halftone"})}),
    PLUNGING.model_copy(
        update={
            "breaker": CREST.model_copy(update={"peels": "left"}),
            "light": Light(sky=Sky()),
            "water": Water(ripples=Ripples()),
        }
    ),
)

CASES = {
    "plunging crest": Cases(
        hard=_HARD,
        invisible=(
            Scene(foam=LEFT),
            Scene(breaker=CREST.model_copy(update={"height": 0.0}), foam=LEFT),
        ),
        variants=_VARIANTS,
    )
}
