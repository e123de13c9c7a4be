"""The land: its soil in detail or smooth, how wet it is, and its shadows. docs/formulae.md, section 8."""

import math

from seafoam.effects.effect import Bound, Contribution, QualityParameter, part_effect
from seafoam.effects.light.atmosphere import lamp
from seafoam.effects.light.light import sun_irradiance
from seafoam.effects.shader import SLOPES, Const, SlotFile, Source
from seafoam.effects.shore.limits import limits
from seafoam.effects.shore.maps import GROUND
from seafoam.framegraph.resources import TargetInput
from seafoam.framegraph.rules import Uniform, number, rounded, significant, vector
from seafoam.quality import Quality
from seafoam.scene.light import Light
from seafoam.scene.models import Scene
from seafoam.scene.shore import Shore

LAND_LIGHT = {False: "shore/land.glsl@land_lit", True: "shore/land.glsl@land_film"}
"""The file that lights land, by whether it has detail."""
FILM_DRIES, SAND_DRIES = 4.0, 40.0
"""Times in which the film of water on sand and the sand dry to 1/e, s."""
SUN_RADIUS = 0.00465
"""Angular radius of the sun and of the moon, rad."""
LOWEST_RISE = 1e-3
"""Least slope of a sight of the sun's rim."""
SUNLIT_FROM = (*GROUND, "shore/sunlit.glsl@sunlit_from")
"""Files of the heights from which the sun is seen over the land."""
NO_SHADOWS = ("shore/sunlit.glsl@sunlit_from_none",)


def soil_files(shore: Shore) -> tuple[str, ...]:
    """Files of the land's material; the noise library and shore/ground.glsl@ground come before them."""
    if shore.detail <= 0.0:
        return ("shore/soil.glsl@soil_struct", "shore/soil.glsl@soil_plain")
    return (*SLOPES, "shore/soil.glsl@soil_struct", "shore/soil.glsl@soil")


def wet_files(shore: Shore) -> tuple[str, ...]:
    swash = shore.detail > 0.0 and shore.surf.height > 0.0
    return ("shore/soil.glsl@wet",) if swash else ("shore/soil.glsl@wet_still",)


def shallow_files(shore: Shore) -> tuple[str | Source, ...]:
    """Files of the floor's colour; shore/ground.glsl@ground comes before them."""
    if shore.detail <= 0.0:
        return ("shore/floor.glsl@shallow_plain",)
    return (*soil_files(shore), "shore/floor.glsl@shallow")


def soil_consts(shore: Shore, quality: Quality) -> dict[str, Const]:
    octaves: dict[str, Const] = {"LAND_OCTAVES": quality.land_octaves} if shore.detail > 0.0 else {}
    return {"FILM_ROUGHNESS": 0.003 if shore.detail > 0.0 else 0.02, **octaves}


def soil_uniforms(shore: Shore) -> dict[str, Uniform]:
    if shore.detail <= 0.0:
        return {}
    period = shore.surf.period
    return {
        "u_land_detail": number(shore.detail),
        "u_land_strand": number(significant(0.4 * shore.surf.height + 0.12)),
        "u_land_dries": vector((significant(FILM_DRIES / period), significant(SAND_DRIES / period))),
    }


def throws(scene: Scene) -> bool:
    return scene.shore is not None and scene.shore.shadows and scene.light is not None and _lit(scene.light)


def _shadows(scene: Scene, shore: Shore, drawn: bool, quality: Quality) -> Contribution | None:
    light = scene.light
    if light is None:
        return None
    ground = ("shore/ground.glsl@place", "shore/ground.glsl@square", "shore/ground.glsl@spline")
    needs = (*ground, "shore/land.glsl@land_maxima")
    return Contribution(
        why="how much of the sun is seen over the land",
        slots=(SlotFile("open sun", "shore/sunlit.glsl@sunlit", prefix="land", needs=needs),),
        consts={"SHADOW_STEPS": quality.shadow_steps},
        uniforms={"u_land_sun": vector(rounded(sights(light)))},
        inputs={"u_land_maxima": TargetInput(target="land_maxima")},
        bound=Bound.zero_if(not _lit(light), "the sun is below the horizon")
        or Bound.zero_if(limits(shore, quality).land_top <= -0.6 * shore.deep, "no land is above the water"),
    )


def sights(light: Light) -> tuple[float, float, float, float]:
    """Level unit vector toward the sun, (x, z), and the slopes of the sights of its upper and lower rim."""
    x, y, z = lamp(light)
    elevation = math.atan2(y, math.hypot(x, z))
    level = max(math.hypot(x, z), 1e-6)
    upper = min(elevation + SUN_RADIUS, 1.5)
    lower = min(elevation - SUN_RADIUS, 1.49)
    return x / level, z / level, max(math.tan(upper), LOWEST_RISE), max(math.tan(lower), LOWEST_RISE)


def _lit(light: Light) -> bool:
    return bool(sun_irradiance(light).any())


def _unshadowed(scene: Scene) -> Scene:
    assert scene.shore is not None
    return scene.model_copy(update={"shore": scene.shore.model_copy(update={"shadows": False})})


SHADOWS = part_effect(
    "shadows of land",
    _shadows,
    "/shore/shadows",
    QualityParameter("/shadow_steps", "steps toward the sun over the land", (32, 64, 128, 256), "geometry"),
    without=_unshadowed,
)
