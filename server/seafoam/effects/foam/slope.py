"""Foam saturation from the surface's slope (GPU ocean, 2007). docs/formulae.md, section 4."""

import math

from seafoam.effects.bounds import slope_limit
from seafoam.effects.effect import Bound, Const, Contribution, Effect, HardCase, Knob, SlotFile
from seafoam.framegraph.rules import Uniform, number
from seafoam.quality import Quality
from seafoam.scene.models import Camera, Foam, HeightSaturation, ParametricWave, Scene, SlopeSaturation
from seafoam.scene.rings import Ring

WIDENED = 1.5
"""Side of the box that stands for the five places of a blur, in blurs: nearest to them on choppy lakes."""


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by a saturation with source ``slope``."""
    if scene.foam is None:
        return None
    found = [(i, s) for i, s in enumerate(scene.foam.saturation) if isinstance(s, SlopeSaturation)]
    if not found:
        return None
    index, slope = found[0]
    # Where nothing is filtered nothing is left of a wider footprint.
    blurred = "slope_widened" if quality.slope_places == 1 and quality.surface.filter else "slope_blurred"
    name = blurred if slope.blur > 0.0 else "slope"
    consts: dict[str, Const] = {"SLOPE_MOST": 1.0 if scene.foam.look == "filtered" else 4.0}
    if name == "slope_widened":
        consts["SLOPE_WIDENED"] = WIDENED
    pointer = f"/foam/saturation/{index}"
    uniforms: dict[str, Uniform] = {
        "u_slope_gain": number(slope.gain, f"{pointer}/gain"),
        "u_slope_base": number(slope.base, f"{pointer}/base"),
    }
    if slope.blur > 0.0:
        uniforms["u_slope_blur"] = number(slope.blur)
    return Contribution(
        why=f"slope saturation, {slope.gain:g} times what the normal lacks of upright",
        slots=(
            SlotFile("saturation", f"saturation/{name}.glsl", prefix="slope", needs=("saturation/slope_lack.glsl",)),
        ),
        consts=consts,
        uniforms=uniforms,
        bound=Bound(0.0, "nothing raises the surface, so nothing is steep")
        if slope_limit(slope, scene) == 0.0
        else None,
    )


EFFECT = Effect(
    "slope foam",
    contribute,
    invisible=(
        Scene(foam=Foam(saturation=(SlopeSaturation(),), look="halftone")),
        Scene(
            waves=(ParametricWave(amplitude=0.0),),
            foam=Foam(saturation=(HeightSaturation(base=-0.2, full=1.0), SlopeSaturation(blur=1.0)), look="filtered"),
        ),
    ),
    knobs=(Knob("/slope_places", "places at which blurred slopes are read", (1, 5), "filtering"),),
    hard_cases=(
        HardCase(
            name="foam on walls",
            scene=Scene(
                waves=(ParametricWave(amplitude=3.0, wavelength=4.0, exponent=6.0),),
                foam=Foam(saturation=(SlopeSaturation(gain=1000.0),), look="fading"),
            ),
            guard="f held in [0, 4] (saturation/slope_lack.glsl)",
            without="f = 806 on a slope of 5.1; the fading look clamps what follows",
            camera=Camera(position=(0.0, 6.0, 0.0), pitch=-0.5),
        ),
        HardCase(
            name="foam on a cusp",
            scene=Scene(
                waves=(ParametricWave(amplitude=0.4, wavelength=3.0, exponent=0.3),),
                foam=Foam(saturation=(SlopeSaturation(blur=0.3), HeightSaturation()), look="textured"),
            ),
            guard="1 - n.y from 1 + slope squared, never from a quotient of slopes (saturation/slope_lack.glsl)",
            without="nothing here: slopes are held at the trough (waves/parametric.glsl)",
            camera=Camera(position=(0.37, 3.0, -0.21), pitch=-math.pi / 2),
        ),
        HardCase(
            name="foam on the steepest of many rings",
            scene=Scene(
                rings=tuple(
                    Ring(place=(0.4 * i, -8.0), birth=-0.1 * i, amplitude=0.05, decay=0.3, wavelength=0.8 + 0.2 * i)
                    for i in range(8)
                ),
                foam=Foam(saturation=(SlopeSaturation(gain=12.0, base=0.02),), look="filtered"),
            ),
            guard="what the footprint takes out of the slope still counts (saturation/slope_lack.glsl)",
            without="from 60 m up: foam on 4e-6 of the picture instead of 7.5e-4 (64 samples a pixel: 2.0e-3)",
            times=(2.0, 4.0),
            camera=Camera(position=(0.0, 4.0, 0.0), pitch=-0.4),
        ),
    ),
)
