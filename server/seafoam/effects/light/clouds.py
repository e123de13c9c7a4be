"""Clouds, layers of gradient noise over a round earth, and their shadows. docs/formulae.md, section 9."""

import math

from seafoam.effects.effect import Bound, Contribution, PassSpec, QualityParameter, Resources, drawn_map, part_effect
from seafoam.effects.light import atmosphere, overcast
from seafoam.effects.light.atmosphere import lamp
from seafoam.effects.light.light import sun_irradiance
from seafoam.effects.shader import COMMON, NOISE_CELLS, PERLIN_2, PERLIN_3, SlotFile, SlotRef, drifting_noise
from seafoam.framegraph.resources import MIPMAPPED, FixedSize, Target
from seafoam.framegraph.rules import Phase, array, number, rounded, vector
from seafoam.quality import Quality
from seafoam.scene import Cirrus, Clouds, Light, Scene, Sky

MAP_SIDE = 32
"""Side of the map of the clouds that the water mirrors, texels."""
LEAST_SLOPE = 0.05
"""Root mean square slope of ripples from which the water mirrors clouds from the map: it turns a mirrored look by twice
as much, some two texels."""
_SKY = (*COMMON, SlotRef("sky"), "light/sky.glsl@mirrored_pass")
_MIRRORED = drawn_map(
    PassSpec("clouds that the water mirrors", "clouds_mirrored", _SKY),
    Target(size=FixedSize.square(MAP_SIDE), format="RGBA16F", filter=MIPMAPPED),
).joined(Resources(slots=(SlotFile("mirrored", "light/sky.glsl@mirrored_map"),), consts={"CLOUDS_SIDE": MAP_SIDE}))
_STREAKS = ((True, 1.0 / 8.0), (False, 1.0), (True, 0.125), (False, 0.25))
"""Axes of the noise of streaks and of their patches: along the streaks or across, and cells per size."""
EARTH = 6.371e6
"""Radius, m."""
MIDDLE, SPAN = 0.4, 0.9
"""Height of the clouds' middle slice, of their depth, and the farthest that slices are parted, cells; as in
``light/clouds.glsl@layer``."""
PENUMBRA = 0.00233
"""Standard deviation of directions over the sun's disc, rad."""


def _draw(scene: Scene, light: Light, sky: Sky, clouds: Clouds, quality: Quality) -> Contribution:
    mean, parted = overcast.cloud_means(light, clouds)
    shape = clouds.height, clouds.size, overcast.cloud_start(clouds), clouds.thickness
    rain = (SlotFile("rain", "light/clouds.glsl@rain"),) if clouds.rain > 0.0 else ()
    contribution = Contribution(
        why=f"clouds over {100 * clouds.cover:.0f} % of the sky",
        slots=(SlotFile("clouds", "light/clouds.glsl@layer", needs=(*PERLIN_3, "light/clouds.glsl@way")), *rain),
        consts={"CLOUD_OCTAVES": quality.cloud_octaves, "CLOUD_SEED": 64 * clouds.seed},
        uniforms={
            "u_cloud_phase": drifting_noise(clouds.size, clouds.wind_speed, clouds.downwind, clouds.change),
            "u_cloud_shape": vector(rounded(shape)),
            "u_cloud_mean": vector(rounded(mean)),
            "u_cloud_parted": vector(rounded(parted)),
            "u_cloud_far": vector(rounded(overcast.cloud_far(light, clouds))),
            "u_cloud_tall": number(clouds.depth, None if clouds.shadows > 0.0 else "/light/sky/clouds/depth"),
            "u_cloud_rain": number(clouds.rain, "/light/sky/clouds/rain"),
            "u_cloud_softness": number(clouds.softness),
            "u_cloud_edge": vector(rounded(overcast.cloud_edge(clouds))),
            "u_cloud_toward": vector(rounded(atmosphere.lamp(light))),
            "u_cloud_light": vector(rounded(overcast.cloud_light(light, clouds.height))),
            "u_cloud_sky": vector(rounded(overcast.cloud_sky(light))),
        },
        bound=Bound.zero_if(clouds.cover == 0.0, "clouds cover no part of the sky")
        or Bound.zero_if(clouds.thickness == 0.0, "clouds have no thickness"),
    )
    # The water mirrors the sky alone, and its slopes blur what is as small as a texel of the map.
    ripples = scene.water.ripples
    blurred = scene.sea is not None or (ripples is not None and ripples.slope >= LEAST_SLOPE)
    mapped = quality.clouds_mirrored == "map" and blurred and light.reflection == "sky"
    return contribution.joined(_MIRRORED) if mapped else contribution


def _cirrus(scene: Scene, light: Light, sky: Sky, high: Cirrus, quality: Quality) -> Contribution:
    heading = (math.cos(high.downwind), math.sin(high.downwind))
    return Contribution(
        why=f"high clouds over {100 * high.cover:.0f} % of the sky",
        slots=(SlotFile("cirrus", "light/clouds.glsl@cirrus", needs=(*PERLIN_2, "light/clouds.glsl@way")),),
        consts={"CIRRUS_SEED": 64 * high.seed},
        uniforms={
            "u_cirrus_phase": array("float", tuple(_streak(high, heading, *part) for part in _STREAKS), 4),
            "u_cirrus_shape": vector(rounded((high.height, high.size, overcast.cirrus_start(high), high.thickness))),
            "u_cirrus_along": vector(rounded(heading)),
            "u_cirrus_light": vector(rounded(overcast.cloud_light(light, high.height))),
            "u_cirrus_sky": vector(rounded(overcast.cloud_sky(light))),
        },
        bound=Bound.zero_if(high.cover * high.thickness == 0.0, "high clouds cover no part of the sky"),
    )


def _streak(high: Cirrus, heading: tuple[float, float], along: bool, share: float) -> Phase:
    k = 2.0 * math.pi / (NOISE_CELLS * high.size) * share
    axis = heading if along else (-heading[1], heading[0])
    return Phase(offset=0.0, rate=-k * high.wind_speed if along else 0.0, k=(k * axis[0], k * axis[1]))


def _shadows(scene: Scene, light: Light, sky: Sky, clouds: Clouds, strength: float, quality: Quality) -> Contribution:
    if clouds.cover * clouds.thickness == 0.0:
        return Contribution.invisible("there are no clouds")
    passed = max(1.0 - overcast.cloud_mean(clouds), overcast.LEAST_PASSED)
    needs = (*PERLIN_3, "light/clouds.glsl@way", "light/clouds.glsl@layer")
    return Contribution(
        why=f"clouds leave {100.0 * passed:.0f} % of the sunlight in the mean",
        slots=(SlotFile("open sun", "light/clouds.glsl@shadow", prefix="cloud", needs=needs),),
        consts={"CLOUD_SHADOW_OCTAVES": quality.cloud_shadow_octaves},
        uniforms={
            "u_cloud_sunward": vector(rounded(sunward(light, clouds))),
            "u_cloud_gap": vector(rounded(overcast.cloud_gap(clouds))),
            "u_cloud_shade": vector(rounded((strength, passed))),
        },
        bound=Bound.zero_if(max(sun_irradiance(light)) == 0.0, "no lamp is above the horizon"),
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


CIRRUS = part_effect("high clouds", _cirrus, "/light/sky/cirrus")
EFFECT = part_effect(
    "clouds",
    _draw,
    "/light/sky/clouds",
    QualityParameter("/cloud_octaves", "octaves of the cloud noise", (2, 3, 4, 5, 6), "geometry"),
    QualityParameter("/clouds_mirrored", "clouds that the water mirrors", ("map", "exact"), "filtering"),
)
SHADOWS = part_effect(
    "shadows of clouds",
    _shadows,
    "/light/sky/clouds/shadows",
    QualityParameter("/cloud_shadow_octaves", "octaves of the clouds' shadows", (1, 2, 3, 4), "geometry"),
)
