"""Test scenes of water.water: hard cases."""

import math
from typing import Any

from support.cases import Cases, HardCase
from support.scenes import Camera, Foam, HeightSaturation, Light, ParametricWave, Ripples, Scene, Shore, Water

_HARD = (
    HardCase(
        "eye on the surface",
        Scene(foam=Foam(saturation=(HeightSaturation(base=-1.0, full=1.0),), look="halftone")),
        guard="the distance along the ray is at least 0 (surface/march.glsl@plane, surface/march.glsl@march)",
        camera=Camera(position=(0.0, 0.0, 0.0), pitch=-0.3),
    ),
    HardCase(
        "no scattering, no roughness to speak of",
        Scene(water=Water(scattering=0.0, roughness=0.01, absorption_length=(0.01, 1000.0, 0.01))),
        guard="the roughness is at least 0.01 (scene/water.py), which keeps the cosine of incidence above 0 "
        "(light/shade.glsl@lit)",
        camera=Camera(position=(0.0, 0.5, 0.0), pitch=0.0),
    ),
    HardCase(
        "the horizon exactly in the middle",
        Scene(),
        guard="rays that do not point downward miss (surface/march.glsl@plane, surface/march.glsl@march); lengths and "
        "quotients are limited at the horizon (light/shade.glsl@lit)",
        camera=Camera(position=(0.0, 6.0, 0.0), pitch=0.0),
    ),
    HardCase(
        "water as rough as it gets, a hundred kilometres up",
        Scene(water=Water(roughness=0.5, ripples=Ripples(slope=0.6))),
        guard="the unresolved slope variance, which is added to the roughness, is never negative "
        "(waves/ripples.glsl@bands)",
        camera=Camera(position=(0.0, 1e5, 0.0), pitch=-0.3, fov=2.6),
    ),
)

_BEACH_BELOW = Shore(size=160.0, radius=25.0, depth=6.0, slope=0.1, smoothing=3.0)

_POOL_BELOW = Water(depth=2.0, floor_tile=0.3, ripples=Ripples(slope=0.08))


def _case_below(name: str, guard: str, camera: Camera, **parts: Any) -> HardCase:
    scene = Scene(**{"water": _POOL_BELOW, "light": Light(exposure=-1.5), **parts})
    return HardCase(name, scene, guard=guard, camera=camera)


_HARD_BELOW = (
    _case_below(
        "past the critical angle",
        "the square of the ray's cosine in air is at least 0 under the root (water/underside.glsl@main)",
        Camera(position=(0.37, -1.2, -0.21), yaw=1.0, pitch=0.35),
    ),
    _case_below(
        "straight up, where light and sight fade alike",
        "1 + fall is at least 1e-3 (water/underside.glsl@water)",
        Camera(position=(0.0, -1.0, 0.0), pitch=math.pi / 2, fov=0.01),
        water=_POOL_BELOW.model_copy(update={"ripples": None}),
    ),
    _case_below(
        "a hair under the surface",
        "the distance to the surface is at least 1 mm (water/underside.glsl@main)",
        Camera(position=(0.0, -1e-7, 0.0), pitch=0.3),
    ),
    _case_below(
        "an eye under the floor",
        "the distance to the floor is at least 0 (water/seafloor.glsl@reach)",
        Camera(position=(0.0, -5.0, 0.0), pitch=-0.2),
    ),
    _case_below(
        "an eye in a crest, below",
        "the distance along the ray is at least 0 (water/underside.glsl@find)",
        Camera(position=(0.0, 0.125, 0.0), pitch=0.1),
        waves=(ParametricWave(amplitude=0.6, wavelength=5.0, phase=math.pi / 2),),
        foam=Foam(look="halftone"),
    ),
    _case_below(
        "straight up from before a beach",
        "the rate at which a ray approaches the floor is at least 1e-6 (shore/march.glsl@reach)",
        Camera(position=(-42.0, -1.2, 9.0), pitch=math.pi / 2),
        water=Water(scattering=0.01),
        shore=_BEACH_BELOW,
    ),
    _case_below(
        "along the slope of a beach, a hand over it",
        "Newton steps are taken only where the ray approaches the floor (shore/march.glsl@reach)",
        Camera(position=(-60.0, -5.9, 9.0), yaw=1.4, pitch=0.09),
        water=Water(scattering=0.01),
        shore=_BEACH_BELOW,
    ),
)

CASES = {
    "water body": Cases(always_visible="it is the water", hard=_HARD),
    "view from below": Cases(
        always_visible="a camera under the surface sees nothing else, and a plan is valid for any camera height",
        hard=_HARD_BELOW,
    ),
}
