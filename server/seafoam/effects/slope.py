"""Foam saturation from the surface's slope (GPU ocean, 2007). docs/formulae.md, section 4."""

from seafoam.effects.contribution import Bound, Contribution, Effect, HardCase, SlotFile, Uniform, number
from seafoam.effects.extremes import slope_limit
from seafoam.quality import Quality
from seafoam.scene.models import Camera, Foam, ParametricWave, Scene, SlopeSaturation
from seafoam.scene.rings import Ring


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by a saturation with source ``slope``."""
    if scene.foam is None:
        return None
    found = [(i, s) for i, s in enumerate(scene.foam.saturation) if isinstance(s, SlopeSaturation)]
    if not found:
        return None
    index, slope = found[0]
    name = ("slope_blurred" if slope.blur > 0.0 else "slope") + ("_filtered" if scene.foam.look == "filtered" else "")
    uniforms: dict[str, Uniform] = {"u_slope_gain": number(slope.gain, f"/foam/saturation/{index}/gain")}
    if slope.blur > 0.0:
        uniforms["u_slope_blur"] = number(slope.blur)
    return Contribution(
        why=f"slope saturation, {slope.gain:g} times what the normal lacks of upright",
        slots=(SlotFile("saturation", f"saturation/{name}.glsl", prefix="slope"),),
        uniforms=uniforms,
        bound=Bound(0.0, "nothing raises the surface, so nothing is steep")
        if slope_limit(slope, scene) == 0.0
        else None,
    )


EFFECT = Effect(
    "slope foam",
    contribute,
    invisible=(Scene(foam=Foam(saturation=(SlopeSaturation(),), look="halftone")),),
)
