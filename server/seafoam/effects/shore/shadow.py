"""Shadows that the land throws on itself, on water and on a floor. docs/formulae.md, section 8."""

import math

from seafoam.effects.effect import Bound, Contribution, Effect, QualityParameter
from seafoam.effects.light.atmosphere import lamp
from seafoam.effects.light.light import sun_irradiance
from seafoam.effects.shader import SlotFile
from seafoam.effects.shore.limits import limits
from seafoam.effects.shore.maps import GROUND
from seafoam.framegraph.resources import TargetInput
from seafoam.framegraph.rules import rounded, vector
from seafoam.quality import Quality
from seafoam.scene.light import Light
from seafoam.scene.models import Scene
from seafoam.scene.shore import Shore

SUN_RADIUS = 0.00465
"""Angular radius of the sun and of the moon, rad."""
LOWEST_RISE = 1e-3
"""Least slope of a sight of the sun's rim."""

SUNLIT_FROM = (*GROUND, "shore/sunlit.glsl@sunlit_from")
"""Files of the heights from which the sun is seen over the land."""
NO_SHADOWS = ("shore/sunlit.glsl@sunlit_from_none",)


def throws(scene: Scene) -> bool:
    """Whether the land's shadows are drawn."""
    return scene.shore is not None and scene.shore.shadows and scene.light is not None and _lit(scene.light)


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Active if the scene has a light, and a shore with ``shadows``."""
    shore, light = scene.shore, scene.light
    if shore is None or light is None or not shore.shadows:
        return None
    return Contribution(
        why="how much of the sun is seen over the land",
        slots=(
            SlotFile(
                "open sun",
                "shore/sunlit.glsl@sunlit",
                prefix="land",
                needs=(
                    "shore/ground.glsl@place",
                    "shore/ground.glsl@square",
                    "shore/ground.glsl@spline",
                    "shore/land.glsl@land_maxima",
                ),
            ),
        ),
        consts={"SHADOW_STEPS": quality.shadow_steps},
        uniforms={"u_land_sun": vector(rounded(sights(light)))},
        inputs={"u_land_maxima": TargetInput(target="land_maxima")},
        bound=_bound(shore, light, quality),
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


def _bound(shore: Shore, light: Light, quality: Quality) -> Bound | None:
    if not _lit(light):
        return Bound(0.0, "the sun is below the horizon")
    return Bound(0.0, "no land is above the water") if limits(shore, quality).land_top <= -0.6 * shore.deep else None


def _unshadowed(scene: Scene) -> Scene:
    assert scene.shore is not None
    return scene.model_copy(update={"shore": scene.shore.model_copy(update={"shadows": False})})


EFFECT = Effect(
    "shadows of land",
    contribute,
    fields=("/shore/shadows",),
    parameters=(
        QualityParameter("/shadow_steps", "steps toward the sun over the land", (32, 64, 128, 256), "geometry"),
    ),
    without=_unshadowed,
)
