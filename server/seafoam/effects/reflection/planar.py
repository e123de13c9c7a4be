"""Planar reflection: a mirrored camera draws boats into a map that the water reads. docs/formulae.md, section 10b."""

from seafoam.effects.boats.boat import COURSE, LIGHT, TRACE
from seafoam.effects.effect import (
    Bound,
    Contribution,
    Effect,
    Inline,
    Knob,
    PassSpec,
    Piece,
    SlotFile,
    SlotRef,
    constant_function,
)
from seafoam.effects.reflection.cubemap import LIT_LAND, SHORE
from seafoam.framegraph.resources import FixedSize, Target, TargetInput, TextureInput
from seafoam.quality import Quality
from seafoam.scene.camera import Camera
from seafoam.scene.models import Scene

MARGIN = 1.25
"""The map is so much wider than the picture: ripples mirror what lies beside it."""
STEPS = 3
"""How often the reflected ray asks the map how far its light has come."""

LOOKS = 8
"""At how many places along the reflected ray land is looked for, each twice as far as the one before."""


_NO_BOATS = Inline(
    "float boats_met(vec3 o, vec3 d, bool far, out vec3 light) {\n    light = vec3(0.0);\n    return -1.0;\n}\n"
)
_NO_LAND = Inline("float land_met(vec3 o, vec3 d, out vec3 light) {\n    light = vec3(0.0);\n    return -1.0;\n}\n")
_NO_GUESS = constant_function("float", "mirror_guess", "vec3 place, vec3 r", "-1.0")


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by a light whose ``reflection`` is planar."""
    if scene.light is None or scene.light.reflection != "planar":
        return None
    if not scene.boats and scene.shore is None:
        return Contribution(
            why="nothing stands over the water",
            bound=Bound(0.0, "nothing stands over the water"),
        )
    boats: tuple[Piece, ...] = (*TRACE, *LIGHT, "reflection/boats_met.glsl") if scene.boats else (_NO_BOATS,)
    if quality.reflection == "traced":
        met = (*boats, *_land(scene), "reflection/met.glsl")
        return Contribution(
            why=f"rays from the water to {_things(scene)}",
            slots=(SlotFile("reflection", "reflection/traced.glsl", needs=met),),
        )
    size = quality.reflection_size
    guess: tuple[Piece, ...] = (COURSE, "reflection/guess.glsl") if scene.boats else (_NO_GUESS,)
    inputs: dict[str, TextureInput | TargetInput] = {}
    if scene.shore is not None:
        inputs["u_shore_floor"] = TextureInput(texture="shore_floor")
    return Contribution(
        why=f"a mirrored camera sees {_things(scene)}, {size} texels a side",
        slots=(SlotFile("reflection", "reflection/planar.glsl", needs=guess),),
        consts={
            "MIRROR_SIZE": size,
            "MIRROR_MARGIN": MARGIN,
            "MIRROR_STEPS": STEPS,
            "MIRROR_LOOKS": 0 if scene.shore is None else LOOKS,
            "MIRROR_FAR": 0.0 if scene.shore is None else scene.shore.size,
        },
        inputs={"u_mirror": TargetInput(target="mirror")},
        targets={"mirror": Target(size=FixedSize(width=size, height=size), format="RGBA16F")},
        passes=(
            PassSpec(
                name=f"planar mirror, {size} texels",
                program="mirror",
                fragment=(
                    "lib/numbers.glsl",
                    "lib/camera.glsl",
                    SlotRef("sky"),
                    *boats,
                    *_land(scene),
                    "reflection/met.glsl",
                    "reflection/map_pass.glsl",
                ),
                target="mirror",
                inputs=inputs,
            ),
        ),
    )


def _land(scene: Scene) -> tuple[Piece, ...]:
    """What finds and lights land."""
    return (_NO_LAND,) if scene.shore is None else (*SHORE, *LIT_LAND, "reflection/land_met.glsl")


def _things(scene: Scene) -> str:
    return " and ".join(name for name, there in (("boats", scene.boats), ("land", scene.shore)) if there)


_VIEW = Camera(position=(0.0, 3.0, 12.0), pitch=-0.2)

EFFECT = Effect(
    "planar reflection",
    contribute,
    knobs=(
        Knob("/reflection", "planar mirror", ("map", "traced"), "filtering"),
        Knob("/reflection_size", "texels of the planar mirror", (128, 256, 512, 1024), "filtering"),
    ),
)
