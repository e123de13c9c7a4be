"""Planar reflection: a mirrored camera draws boats and land into a map. docs/formulae.md, section 10b."""

from seafoam.effects.boats.boat import COURSE, LIGHT, TRACE
from seafoam.effects.effect import Contribution, Effect, PassSpec, QualityParameter
from seafoam.effects.reflection.cubemap import SHORE, SURROUNDINGS, lit_land
from seafoam.effects.shader import Inline, Piece, SlotFile, constant_function
from seafoam.framegraph.resources import FixedSize, Target, TargetInput
from seafoam.quality import Quality
from seafoam.scene.models import Scene

MARGIN = 1.25
"""Width of the map relative to the picture: ripples reflect objects beside it."""
STEPS = 3
"""Number of reads of the map's distance with which a reflected ray is traced."""

LOOKS = 8
"""Number of points along the reflected ray at which land is searched for, each twice as far as the last."""


_NO_BOATS = Inline(
    "float boats_met(vec3 o, vec3 d, bool far, out vec3 light) {\n    light = vec3(0.0);\n    return -1.0;\n}\n"
)
_NO_LAND = Inline("float land_met(vec3 o, vec3 d, out vec3 light) {\n    light = vec3(0.0);\n    return -1.0;\n}\n")
_NO_GUESS = constant_function("float", "mirror_guess", "vec3 place, vec3 r", "-1.0")


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Active if the light's ``reflection`` is "planar"."""
    if scene.light is None or scene.light.reflection != "planar":
        return None
    if not scene.boats and scene.shore is None:
        return Contribution.invisible("no boat or land is above the water")
    boats: tuple[Piece, ...] = (*TRACE, *LIGHT, "reflection/mirror.glsl@boats_met") if scene.boats else (_NO_BOATS,)
    met = (*boats, *_land(scene), "reflection/mirror.glsl@met")
    if quality.reflection == "traced":
        return Contribution(
            why=f"reflected rays are traced to {_objects(scene)}",
            slots=(SlotFile("reflection", "reflection/mirror.glsl@traced", needs=met),),
        )
    size = quality.reflection_size
    guess: tuple[Piece, ...] = (COURSE, "reflection/mirror.glsl@guess") if scene.boats else (_NO_GUESS,)
    return Contribution(
        why=f"a mirrored camera draws {_objects(scene)}, {size} texels a side",
        slots=(SlotFile("reflection", "reflection/mirror.glsl@planar", needs=guess),),
        consts={
            "MIRROR_SIZE": size,
            "MIRROR_MARGIN": MARGIN,
            "MIRROR_STEPS": STEPS,
            "MIRROR_LOOKS": 0 if scene.shore is None else LOOKS,
            "MIRROR_FAR": 0.0 if scene.shore is None else scene.shore.size,
        },
        inputs={"u_mirror": TargetInput(target="mirror")},
        targets={"mirror": Target(size=FixedSize.square(size), format="RGBA16F")},
        passes=(
            PassSpec(
                name=f"planar mirror, {size} texels",
                program="mirror",
                fragment=(*SURROUNDINGS, *met, "reflection/mirror.glsl@map_pass"),
            ),
        ),
    )


def _land(scene: Scene) -> tuple[Piece, ...]:
    """Files that intersect and light land."""
    return (_NO_LAND,) if scene.shore is None else (*SHORE, *lit_land(scene.shore), "reflection/mirror.glsl@land_met")


def _objects(scene: Scene) -> str:
    return " and ".join(name for name, there in (("boats", scene.boats), ("land", scene.shore)) if there)


EFFECT = Effect(
    "planar reflection",
    contribute,
    fields=("/light/reflection",),
    parameters=(
        QualityParameter("/reflection", "planar mirror", ("map", "traced"), "filtering"),
        QualityParameter("/reflection_size", "texels of the planar mirror", (128, 256, 512, 1024), "filtering"),
    ),
)
