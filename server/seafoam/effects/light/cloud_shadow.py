"""Shadows of clouds on water and land, and the sunlight between them. docs/formulae.md, section 9."""

import math

from seafoam.effects.effect import Bound, Contribution, Effect, QualityParameter
from seafoam.effects.light import overcast
from seafoam.effects.light.atmosphere import lamp
from seafoam.effects.light.light import sun_irradiance
from seafoam.effects.noise import PERLIN_3
from seafoam.effects.shader import SlotFile
from seafoam.framegraph.rules import rounded, vector
from seafoam.quality import Quality
from seafoam.scene.light import Clouds, Light
from seafoam.scene.models import Scene

EARTH = 6.371e6
"""Radius, m."""
MIDDLE, SPAN = 0.4, 0.9
"""Height of the clouds' middle slice, of their depth, and the farthest that slices are parted, cells; as in
``light/clouds.glsl@layer``."""
PENUMBRA = 0.00233
"""Standard deviation of directions over the sun's disc, rad."""


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Active if the clouds have ``shadows``."""
    light = scene.light
    if light is None or light.sky is None or light.sky.clouds is None or light.sky.clouds.shadows == 0.0:
        return None
    clouds = light.sky.clouds
    if clouds.cover * clouds.thickness == 0.0:
        return Contribution.invisible("there are no clouds")
    passed = max(1.0 - overcast.cloud_mean(clouds), overcast.LEAST_PASSED)
    return Contribution(
        why=f"clouds leave {100.0 * passed:.0f} % of the sunlight in the mean",
        slots=(
            SlotFile(
                "open sun",
                "light/clouds.glsl@shadow",
                prefix="cloud",
                needs=(*PERLIN_3, "light/clouds.glsl@way", "light/clouds.glsl@layer"),
            ),
        ),
        consts={"CLOUD_SHADOW_OCTAVES": quality.cloud_shadow_octaves},
        uniforms={
            "u_cloud_sunward": vector(rounded(sunward(light, clouds))),
            "u_cloud_gap": vector(rounded(overcast.cloud_gap(clouds))),
            "u_cloud_shade": vector(rounded((clouds.shadows, passed))),
        },
        bound=Bound(0.0, "no lamp is above the horizon") if max(sun_irradiance(light)) == 0.0 else None,
    )


def sunward(light: Light, clouds: Clouds) -> tuple[float, float, float, float]:
    """Way from still water toward the lamp to the clouds, along x and z, its height in them, and the standard
    deviation of the place where the lamp's disc is seen through them; cells."""
    x, y, z = lamp(light)
    along, rest = EARTH * y, (2.0 * EARTH + clouds.height) * clouds.height
    way = rest / (along + math.sqrt(along * along + rest))
    slant = (along + way) / (EARTH + clouds.height)
    tall = clouds.depth / clouds.size
    level = way / clouds.size + MIDDLE * min(tall / slant, SPAN)
    return level * x, level * z, MIDDLE * tall, PENUMBRA * way / (clouds.size * math.sqrt(slant))


EFFECT = Effect(
    "shadows of clouds",
    contribute,
    fields=("/light/sky/clouds/shadows",),
    parameters=(QualityParameter("/cloud_shadow_octaves", "octaves of the clouds' shadows", (1, 2, 3, 4), "geometry"),),
)
