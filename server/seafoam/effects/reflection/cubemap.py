"""Reflection of sky and land from a cube map around the point below the camera. docs/formulae.md, section 10."""

import math

from seafoam.effects.effect import Bound, Contribution, Effect, PassSpec, QualityParameter
from seafoam.effects.light.light import ILLUMINATION, air_light, sky_irradiance, sun_irradiance
from seafoam.effects.noise import VALUE_NOISE
from seafoam.effects.shader import SlotFile, SlotRef
from seafoam.effects.shore.land import LAND_LIGHT, soil_files
from seafoam.effects.shore.maps import MAXIMA
from seafoam.framegraph.resources import FixedSize, Target, TargetInput
from seafoam.quality import Quality
from seafoam.scene.light import Light
from seafoam.scene.models import Scene
from seafoam.scene.shore import Shore

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


SURROUNDINGS: tuple[str | SlotRef, ...] = (
    "lib/numbers.glsl",
    "lib/rays.glsl@camera",
    *map(SlotRef, ("sky", "mirrored", "open sun", "sunlight")),
)
"""First files of passes that draw them."""


def lit_land(shore: Shore) -> tuple[str, ...]:
    """Files that light the land along any ray."""
    look = (*soil_files(shore), LAND_LIGHT[shore.detail > 0.0])
    return (*ILLUMINATION, "lib/refraction.glsl", *look, "reflection/mirror.glsl@land")


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Active if the light's ``reflection`` is "cubemap"."""
    light = scene.light
    if light is None or light.reflection != "cubemap":
        return None
    shore = scene.shore
    scenery: tuple[str, ...] = ("reflection/mirror.glsl@open",)
    if shore is not None:
        scenery = (*SHORE, *lit_land(shore), "reflection/mirror.glsl@land_around")
    if quality.cube == "exact":
        return Contribution(
            why="reflects sky and land, traced for each sample",
            slots=(SlotFile("reflection", "reflection/mirror.glsl@exact", needs=scenery),),
            bound=_bound(scene, light),
        )
    return Contribution(
        why=f"reflects sky{' and land' if shore else ''} from a cube map of six faces of {quality.cube_size}²",
        slots=(
            SlotFile(
                "reflection",
                "reflection/cube.glsl@cubemap",
                needs=(
                    "lib/texels.glsl@bilinear",
                    "lib/texels.glsl@cube_face",
                    "reflection/cube.glsl@cube",
                    "reflection/cube.glsl@texel",
                ),
            ),
        ),
        consts={"CUBE_SIZE": quality.cube_size},
        inputs={"u_cube": TargetInput(target="cube")},
        targets={
            "cube": Target(size=FixedSize(width=3 * quality.cube_size, height=2 * quality.cube_size), format="RGBA16F")
        },
        passes=(
            PassSpec(
                name="cube map",
                program="cube",
                fragment=(
                    *SURROUNDINGS,
                    *scenery,
                    "lib/texels.glsl@cube_face",
                    "reflection/cube.glsl@cube",
                    "reflection/cube.glsl@pass",
                ),
            ),
        ),
        bound=_bound(scene, light),
    )


def _bound(scene: Scene, light: Light) -> Bound | None:
    """Reflected light is no brighter than fully lit white land or the brightest sky."""
    factor = 2.0**light.exposure
    if light.sky is not None:
        return None
    land = max(sun_irradiance(light) + sky_irradiance(light)) / math.pi
    # The brightest point of the sky, where all light is scattered forward.
    brightest = max(air_light(light)) * 2.6
    return Bound(factor * max(land, brightest), "there is no light to reflect", ("/light/exposure",))


EFFECT = Effect(
    "cube map",
    contribute,
    fields=("/light/reflection",),
    parameters=(
        QualityParameter("/cube", "reflected surroundings", ("map", "exact"), "geometry"),
        QualityParameter("/cube_size", "texels of a face of the cube map", (32, 64, 128, 256, 512), "geometry"),
    ),
)
