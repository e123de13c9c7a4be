"""Foam's thickness: it shades the water beside it, edges toward the sun are brighter. docs/formulae.md, section 6."""

import math

from seafoam.effects.bounds import body_limit, foam_limit, greatest_saturation, saturation_fields
from seafoam.effects.effect import Bound, Contribution, Effect, HardCase, Knob, SlotFile
from seafoam.framegraph.rules import number
from seafoam.ocean.stokes import foam_life
from seafoam.quality import Quality
from seafoam.scene.living import FoamLife
from seafoam.scene.models import Camera, Foam, FrontSaturation, HeightSaturation, Light, ParametricWave, Scene

SHADE = 0.6
"""Share of the sun that a hand's breadth of foam takes from what lies behind it; the rest comes through."""


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by ``foam.thickness`` where there is light, in the finer tiers."""
    foam = scene.foam
    if foam is None or scene.light is None or foam.thickness == 0.0 or not quality.foam_relief:
        return None
    most = min(greatest_saturation(foam, scene), 1.0)
    beside = "foam/beside.glsl"
    if foam.look == "filtered":
        beside = "foam/beside_lying.glsl" if foam_life(scene) is not None else "foam/beside_filtered.glsl"
    return Contribution(
        why=f"foam {foam.thickness:g} m thick shades what lies beside it",
        slots=(SlotFile("relief", "foam/relief.glsl", needs=(beside,)),),
        consts={"FOAM_SHADE": SHADE},
        uniforms={"u_foam_thickness": number(foam.thickness, "/foam/thickness")},
        bound=Bound(
            0.0 if most == 0.0 else body_limit(scene) + foam_limit(foam, scene),
            "no foam that could shade",
            saturation_fields(foam),
        ),
    )


_FOAM = Foam(
    saturation=(HeightSaturation(base=-0.4, full=0.6),), mask="lace", octaves=4, thickness=0.05, life=FoamLife()
)

EFFECT = Effect(
    "foam relief",
    contribute,
    invisible=(
        Scene(
            waves=(ParametricWave(amplitude=0.5),),
            foam=Foam(
                saturation=(FrontSaturation(), HeightSaturation(base=0.6, full=1.0)), combine="product", thickness=0.1
            ),
        ),
    ),
    knobs=(Knob("/foam_relief", "shades of foam", (False, True), "geometry"),),
    hard_cases=(
        HardCase(
            name="foam under a sun on the horizon",
            scene=Scene(light=Light(sun_elevation=0.001, sun_azimuth=2.0), foam=_FOAM),
            guard="the sun's height at least 1/4 in the length of shades (foam/relief.glsl)",
            without="shades 50 m long, of foam that is not the place's",
            camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.3),
        ),
        HardCase(
            name="foam under a sun overhead",
            scene=Scene(light=Light(sun_elevation=math.pi / 2), foam=_FOAM),
            guard="the shade's length at least 1e-6 m (foam/relief.glsl)",
            without="0/0: no shade at all, told by a quotient of nothing",
            camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.3),
        ),
        HardCase(
            name="foam an eye's breadth away",
            scene=Scene(
                light=Light(),
                foam=_FOAM.model_copy(update={"thickness": 1.0, "mask_tile": 0.05}),
            ),
            guard="sides of the footprint at least 1e-6 m before they are widened (foam/relief.glsl)",
            without="nothing on llvmpipe: no footprint is a point",
            camera=Camera(position=(0.0, 1e-3, 0.0), pitch=-math.pi / 2),
        ),
    ),
)
