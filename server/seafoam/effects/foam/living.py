"""Foam with a history: it moves with the water, gathers in windrows, and has other masks with age.

docs/formulae.md, section 5.
"""

import math

from seafoam.effects.effect import Contribution, Effect
from seafoam.effects.foam.surf import surf_limit
from seafoam.effects.noise import CELLS, PERLIN_2, drifting_phases
from seafoam.effects.shader import Piece, SlotFile, Source, constant_function
from seafoam.framegraph.rules import Uniform, number, vector
from seafoam.ocean.waves.stokes import foam_drift, foam_life
from seafoam.quality import Quality
from seafoam.scene.foam import FoamLife, SurfSaturation
from seafoam.scene.models import Scene

AGE = 0.8
"""Age between one mask and the next, in e-folds of the saturation."""
WINDROW_LENGTH = 8.0
"""Length of windrows over their spacing."""
WINDROW_RIDGE = 7.781
"""Factor c for which max(1 - c|n|, -1) has the mean 0 over gradient noise n in the plane (2·10⁶ samples)."""
WINDROW_SEED = 1938


_NO_WINDROWS = constant_function("float", "windrow", "vec2 p, Footprint fp")
_AT_REST = constant_function("vec2", "carry", "vec2 p")
"""No displacement by waves, near a coast as elsewhere."""


def follows_orbits(scene: Scene) -> bool:
    """Whether the waves' orbits move the foam."""
    life = foam_life(scene)
    return life is not None and life.carried


def ageing_look(look: str, life: FoamLife) -> tuple[str, tuple[Piece, ...]]:
    """The file that replaces a look's file for foam with a history, and the files that it needs."""
    rows: tuple[Piece, ...] = (*PERLIN_2, "foam/living.glsl@windrows") if life.row_strength > 0.0 else (_NO_WINDROWS,)
    return "foam/living.glsl@living", (
        *rows,
        "foam/shading.glsl@cover",
        Source(look, (("foam_amount", "young_amount"),)),
    )


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Active if the foam has ``life`` and the filtered look."""
    life = foam_life(scene)
    if life is None:
        return None
    slots = [SlotFile("carry", "foam/carry.glsl@still", prefix="still")]
    if scene.shore is not None:
        surf = None if scene.foam is None else scene.foam.source(SurfSaturation)
        breaks = surf is not None and surf_limit(surf, scene) > 0.0
        carry = "foam/carry.glsl@surf" if breaks else "foam/carry.glsl@shore"
        slots.append(SlotFile("shore carry", carry if life.carried else _AT_REST))
    drift = foam_drift(scene)
    uniforms: dict[str, Uniform] = {}
    if life.row_strength > 0.0:
        c, s = math.cos(life.downwind), math.sin(life.downwind)
        across = 1.0 / life.windrow_spacing
        rows = ((c * across / WINDROW_LENGTH, s * across / WINDROW_LENGTH), (-s * across, c * across))
        uniforms = {
            "u_windrow_phase": drifting_phases(rows, drift, 2.0 * math.pi / CELLS),
            "u_windrow_matrix": vector((*rows[0], *rows[1])),
            "u_windrows": number(life.row_strength, "/foam/life/windrows"),
        }
    return Contribution(
        why=f"foam drifts at {math.hypot(*drift):.2g} m/s"
        + (", moved by the waves' orbits" if life.carried else "")
        + (f", {len(life.masks)} masks for older foam" if life.masks else "")
        + (f", in windrows {life.windrow_spacing:g} m apart" if life.row_strength > 0.0 else ""),
        slots=tuple(slots),
        consts={"WINDROW_RIDGE": WINDROW_RIDGE, "WINDROW_SEED": WINDROW_SEED},
        uniforms=uniforms,
    )


EFFECT = Effect("foam that lives", contribute, fields=("/foam/life",), afloat=("u_windrow_phase",))
