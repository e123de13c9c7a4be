"""Foam saturation from height (Kryachko 2005). docs/formulae.md, section 4."""

from seafoam.effects.contribution import Contribution, Effect, SlotFile, number
from seafoam.quality import Quality
from seafoam.scene.models import HeightSaturation, Scene


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
    )


EFFECT = Effect("height foam", contribute)
