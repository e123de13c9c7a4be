"""Foam of the surf. docs/formulae.md, section 8."""

from seafoam.effects.bounds import SATURATION_CAP
from seafoam.effects.effect import Bound, Contribution, SaturationSource, foam_effect
from seafoam.effects.shader import SlotFile
from seafoam.framegraph.rules import number, significant
from seafoam.quality import Quality
from seafoam.scene.foam import Foam, SurfSaturation
from seafoam.scene.models import Scene


def draw(scene: Scene, foam: Foam, surf: SurfSaturation, quality: Quality) -> Contribution:
    """Foam of a saturation with source ``surf``."""
    pointer = foam.pointer(surf)
    if scene.shore is None:
        return Contribution.invisible("there is no shore to break on")
    height = scene.shore.surf.height
    filtered = foam.look == "filtered"
    torn = "foam/saturation/wake.glsl@torn" if filtered else "foam/saturation/wake.glsl@torn_exact"
    front = "foam/saturation/surf.glsl@front_filtered" if filtered else "foam/saturation/surf.glsl@front"
    needs = (torn, "foam/saturation/surf.glsl@patches", "foam/saturation/surf.glsl@swept", front)
    return Contribution(
        why=f"foam of the surf, {surf.life:g} periods to 1/e",
        slots=(
            SlotFile("saturation", "foam/saturation/surf.glsl@surf", prefix="surf", needs=needs),
            *((SlotFile("land foam", "shore/waves.glsl@line"),) if surf.line > 0.0 else ()),
        ),
        consts={
            "SURF_CAP": 1.0 if filtered else SATURATION_CAP,
            "SURF_FILTERED": filtered,
            "SURF_LINED": surf.line > 0.0,
        },
        uniforms={
            "u_surf_foam": number(surf.amount),
            "u_surf_life": number(surf.life, f"{pointer}/life"),
            "u_surf_veil": number(surf.veil),
            "u_surf_line": number(surf.line),
            "u_surf_scale": number(significant(1.0 / max(height, 1e-6))),
        },
        bound=Bound(0.0, "no wave breaks") if height == 0.0 or surf.amount + surf.veil + surf.line == 0.0 else None,
    )


def surf_limit(surf: SurfSaturation, scene: Scene) -> float:
    """Return the greatest surf saturation: 2.4 times ``amount`` on thin water and twice ``veil``; 0 without surf."""
    if scene.shore is None or scene.shore.surf.height == 0.0:
        return 0.0
    return min(2.4 * surf.amount + 2.0 * surf.veil, SATURATION_CAP)


EFFECT = foam_effect("surf foam", draw, SaturationSource(SurfSaturation, surf_limit))
