"""Foam saturation from height (Kryachko 2005). docs/formulae.md, section 4."""

from seafoam.effects.contribution import Bound, Contribution, Effect, SlotFile, number
from seafoam.effects.extremes import height_limit
from seafoam.quality import Quality
from seafoam.scene.models import Foam, FrontSaturation, HeightSaturation, ParametricWave, Scene


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by a saturation with source ``height``."""
    if scene.foam is None:
        return None
    found = [(i, s) for i, s in enumerate(scene.foam.saturation) if isinstance(s, HeightSaturation)]
    if not found:
        return None
    index, height = found[0]
    pointer = f"/foam/saturation/{index}"
    name = "height_filtered" if scene.foam.look == "filtered" else "height"
    return Contribution(
        why=f"height saturation between {height.base:g} and {height.full:g} m",
        slots=(SlotFile("saturation", f"saturation/{name}.glsl", prefix="height"),),
        uniforms={
            "u_height_base": number(height.base, f"{pointer}/base"),
            "u_height_full": number(height.full, f"{pointer}/full"),
        },
        bound=Bound(0.0, "no crest reaches the height where foam starts", (f"{pointer}/base", f"{pointer}/full"))
        if height_limit(height, scene) == 0.0
        else None,
    )


EFFECT = Effect(
    "height foam",
    contribute,
    invisible=(
        Scene(
            waves=(ParametricWave(amplitude=0.5),),
            foam=Foam(saturation=(FrontSaturation(), HeightSaturation(base=0.5, full=1.0)), look="halftone"),
        ),
    ),
)
