"""Reflections of more than the sky, by a cube map or a mirrored camera. docs/formulae.md, sections 10 and 10b."""

from seafoam.effects.boats.boat import COURSE, LIGHT, TRACE
from seafoam.effects.effect import Contribution, PassSpec, QualityParameter, drawn_map, part_effect
from seafoam.effects.light.light import ILLUMINATION
from seafoam.effects.shader import COMMON, VALUE_NOISE, Piece, SlotFile, SlotRef, constant_function
from seafoam.effects.shore.maps import MAXIMA
from seafoam.effects.shore.shore import LAND_LIGHT, soil_files
from seafoam.framegraph.resources import FixedSize, Target
from seafoam.quality import Quality
from seafoam.scene import Light, Scene, Shore

SHORE = (
    "shore/ground.glsl@place",
    "shore/ground.glsl@square",
    "shore/ground.glsl@spline",
    "shore/floor.glsl@floor",
    *VALUE_NOISE,
    "shore/ground.glsl@ground",
    "surface/march.glsl@step",
    "shore/march.glsl@march",
    *MAXIMA,
)
"""Files that give the land's height and colour."""
SURROUNDINGS: tuple[str | SlotRef, ...] = (*COMMON, *map(SlotRef, ("sky", "mirrored", "open sun", "sunlight")))
"""First files of passes that draw them."""
MARGIN = 1.25
"""Width of the map relative to the picture: ripples reflect objects beside it."""
STEPS = 3
"""Number of reads of the map's distance with which a reflected ray is traced."""
LAND_SIZE = 128
"""Greatest side of a map of land alone in water with ripples, texels: they blur what is finer, and it would alias."""
LOOKS = 8
"""Number of points along the reflected ray at which land is searched for, each twice as far as the last."""
_DARK = "light = vec3(0.0);"
_NO_BOATS = constant_function("float", "boats_met", "vec3 o, vec3 d, bool far, out vec3 light", "-1.0", _DARK)
_NO_LAND = constant_function("float", "land_met", "vec3 o, vec3 d, out vec3 light", "-1.0", _DARK)
_NO_GUESS = constant_function("float", "mirror_guess", "vec3 place, vec3 r", "-1.0")


def lit_land(scene: Scene, shore: Shore) -> tuple[Piece, ...]:
    look = (*soil_files(scene), LAND_LIGHT[shore.detail > 0.0])
    return (*ILLUMINATION, "lib/refraction.glsl", *look, "reflection/mirror.glsl@land")


def _cubemap(scene: Scene, light: Light, reflection: str, quality: Quality) -> Contribution | None:
    if reflection != "cubemap":
        return None
    shore = scene.shore
    scenery: tuple[Piece, ...] = ("reflection/mirror.glsl@open",)
    if shore is not None:
        scenery = (*SHORE, *lit_land(scene, shore), "reflection/mirror.glsl@land_around")
    if quality.cube == "exact":
        slot = SlotFile("reflection", "reflection/mirror.glsl@exact", needs=scenery)
        return Contribution(why="reflects sky and land, traced for each sample", slots=(slot,))
    faces = ("lib/texels.glsl@cube_face", "reflection/cube.glsl@cube")
    needs = ("lib/texels.glsl@bilinear", *faces, "reflection/cube.glsl@texel")
    files = (*SURROUNDINGS, *scenery, *faces, "reflection/cube.glsl@pass")
    size = FixedSize(width=3 * quality.cube_size, height=2 * quality.cube_size)
    return Contribution(
        why=f"reflects sky{' and land' if shore else ''} from a cube map of six faces of {quality.cube_size}²",
        slots=(SlotFile("reflection", "reflection/cube.glsl@cubemap", needs=needs),),
        consts={"CUBE_SIZE": quality.cube_size},
    ).joined(drawn_map(PassSpec("cube map", "cube", files), Target(size=size, format="RGBA16F")))


def _planar(scene: Scene, light: Light, reflection: str, quality: Quality) -> Contribution | None:
    if reflection != "planar":
        return None
    if not scene.boats and scene.shore is None:
        return Contribution.invisible("no boat or land is above the water")
    boats: tuple[Piece, ...] = (*TRACE, *LIGHT, "reflection/mirror.glsl@boats_met") if scene.boats else (_NO_BOATS,)
    land: tuple[Piece, ...] = (_NO_LAND,)
    if scene.shore is not None:
        land = (*SHORE, *lit_land(scene, scene.shore), "reflection/mirror.glsl@land_met")
    met = (*boats, *land, "reflection/mirror.glsl@met")
    objects = " and ".join(name for name, there in (("boats", scene.boats), ("land", scene.shore)) if there)
    if quality.reflection == "traced":
        slot = SlotFile("reflection", "reflection/mirror.glsl@traced", needs=met)
        return Contribution(why=f"reflected rays are traced to {objects}", slots=(slot,))
    blurred = scene.water.ripples is not None and not scene.boats
    size = min(quality.reflection_size, LAND_SIZE) if blurred else quality.reflection_size
    files = (*SURROUNDINGS, *met, "reflection/mirror.glsl@map_pass")
    mirror = PassSpec(f"planar mirror, {size} texels", "mirror", files)
    guess: tuple[Piece, ...] = (COURSE, "reflection/mirror.glsl@guess") if scene.boats else (_NO_GUESS,)
    return Contribution(
        why=f"a mirrored camera draws {objects}, {size} texels a side",
        slots=(SlotFile("reflection", "reflection/mirror.glsl@planar", needs=guess),),
        consts={
            "MIRROR_SIZE": size,
            "MIRROR_MARGIN": MARGIN,
            "MIRROR_STEPS": STEPS,
            "MIRROR_LOOKS": 0 if scene.shore is None else LOOKS,
            "MIRROR_FAR": 0.0 if scene.shore is None else scene.shore.size,
        },
    ).joined(drawn_map(mirror, Target(size=FixedSize.square(size), format="RGBA16F")))


CUBEMAP = part_effect(
    "cube map",
    _cubemap,
    "/light/reflection",
    QualityParameter("/cube", "reflected surroundings", ("map", "exact"), "geometry"),
    QualityParameter("/cube_size", "texels of a face of the cube map", (32, 64, 128, 256, 512), "geometry"),
)
PLANAR = part_effect(
    "planar reflection",
    _planar,
    "/light/reflection",
    QualityParameter("/reflection", "planar mirror", ("map", "traced"), "filtering"),
    QualityParameter("/reflection_size", "texels of the planar mirror", (128, 256, 512, 1024), "filtering"),
)
