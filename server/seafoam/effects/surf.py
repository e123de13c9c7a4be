"""Foam of the surf. docs/formulae.md, section 8."""

from seafoam.effects.contribution import Bound, Contribution, Effect, HardCase, SlotFile, number, significant
from seafoam.effects.extremes import SATURATION_CAP
from seafoam.quality import Quality
from seafoam.scene.models import Camera, Foam, HeightSaturation, Scene, Shore, SurfSaturation
from seafoam.scene.shore import Surf


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by a saturation with source ``surf``."""
    if scene.foam is None:
        return None
    found = [(i, s) for i, s in enumerate(scene.foam.saturation) if isinstance(s, SurfSaturation)]
    if not found:
        return None
    index, surf = found[0]
    pointer = f"/foam/saturation/{index}"
    if scene.shore is None:
        return Contribution(
            why="no shore to break on",
            slots=(SlotFile("saturation", "saturation/no_surf.glsl", prefix="surf"),),
            bound=Bound(0.0, "there is no shore to break on"),
        )
    height = scene.shore.surf.height
    return Contribution(
        why=f"foam of the surf, {surf.life:g} periods to 1/e",
        slots=(SlotFile("saturation", "saturation/surf.glsl", prefix="surf"),),
        consts={"SURF_CAP": 1.0 if scene.foam.look == "filtered" else SATURATION_CAP},
        uniforms={
            "u_surf_foam": number(surf.amount),
            "u_surf_life": number(surf.life, f"{pointer}/life"),
            "u_surf_veil": number(surf.veil),
            "u_surf_scale": number(significant(1.0 / max(height, 1e-6))),
        },
        bound=Bound(0.0, "no wave breaks") if height == 0.0 or surf.amount + surf.veil == 0.0 else None,
    )


_BEACH = Shore(size=160.0, depth=6.0, slope=0.1, smoothing=3.0)
_FOAM = Foam(saturation=(SurfSaturation(),), mask="clump")

EFFECT = Effect(
    "surf foam",
    contribute,
    invisible=(
        Scene(foam=_FOAM),
        Scene(shore=_BEACH.model_copy(update={"surf": Surf(height=0.0)}), foam=_FOAM),
    ),
)
