"""Foam saturation from the surface's slope (GPU ocean, 2007). docs/formulae.md, section 4."""

from seafoam.effects.bounds import SATURATION_CAP, max_surface_height
from seafoam.effects.effect import Bound, Contribution, QualityParameter, SaturationSource, foam_effect
from seafoam.effects.shader import Const, SlotFile
from seafoam.framegraph.rules import Uniform, number
from seafoam.quality import Quality
from seafoam.scene.foam import Foam, SlopeSaturation
from seafoam.scene.models import Scene

WIDENED = 1.5
"""Side of the box that approximates the five points of a blur, in units of the blur: the best fit on choppy lakes."""

_WIDENED = "foam/saturation/slope.glsl@widened"


def draw(scene: Scene, foam: Foam, slope: SlopeSaturation, quality: Quality) -> Contribution:
    """Foam of a saturation with source ``slope``."""
    # Without slope filtering a wider footprint has no effect.
    blurred = _WIDENED if quality.slope_places == 1 and quality.surface.filter else "foam/saturation/slope.glsl@blurred"
    file = blurred if slope.blur > 0.0 else "foam/saturation/slope.glsl@plain"
    consts: dict[str, Const] = {"SLOPE_MOST": 1.0 if foam.look == "filtered" else 4.0}
    if file == _WIDENED:
        consts["SLOPE_WIDENED"] = WIDENED
    pointer = foam.pointer(slope)
    uniforms: dict[str, Uniform] = {
        "u_slope_gain": number(slope.gain, f"{pointer}/gain"),
        "u_slope_base": number(slope.base, f"{pointer}/base"),
    }
    if slope.blur > 0.0:
        uniforms["u_slope_blur"] = number(slope.blur)
    return Contribution(
        why=f"slope saturation, {slope.gain:g} times 1 - n.y of the normal",
        slots=(SlotFile("saturation", file, prefix="slope", needs=("foam/saturation/slope.glsl@lack",)),),
        consts=consts,
        uniforms=uniforms,
        bound=Bound(0.0, "the surface has no waves, so no slope") if slope_limit(slope, scene) == 0.0 else None,
    )


def slope_limit(slope: SlopeSaturation, scene: Scene) -> float:
    """Return the greatest slope saturation: that of a vertical surface; 0 if the surface is level."""
    return min(slope.gain * (1.0 - slope.base), SATURATION_CAP) if max_surface_height(scene) > 0.0 else 0.0


EFFECT = foam_effect(
    "slope foam",
    draw,
    SaturationSource(SlopeSaturation, slope_limit, ("base", "gain")),
    parameters=(QualityParameter("/slope_places", "points of the blurred slope", (1, 5), "filtering"),),
)
