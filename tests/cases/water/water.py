"""Test scenes of water.water: hard cases."""

import math
from typing import Any

from support.cases import Cases, HardCase
from support.hard.mutations import guards
from support.scenes import Camera, Foam, HeightSaturation, Light, ParametricWave, Ripples, Scene, Shore, Water

_HARD = (
    HardCase(
        "eye on the surface",
        Scene(foam=Foam(saturation=(HeightSaturation(base=-1.0, full=1.0),), look="halftone")),
        guard="the distance along the ray is at least 0 (surface/march.glsl@plane, surface/march.glsl@march)",
        camera=Camera(position=(0.0, 0.0, 0.0), pitch=-0.3),
        without={"surface/march.glsl": {"u_eye_height * ray.y >= 0.0": "ray.y >= 0.0"}},
    ),
    HardCase(
        "no scattering, no roughness to speak of",
        Scene(water=Water(scattering=0.0, roughness=0.01, absorption_length=(0.01, 1000.0, 0.01))),
        guard="the roughness is at least 0.01 (scene/water.py), which keeps the cosine of incidence above 0 "
        "(light/shade.glsl@lit)",
        camera=Camera(position=(0.0, 0.5, 0.0), pitch=0.0),
        without={
            "scene/water.py": {
                "roughness: float = Field(default=0.05, ge=0.01": "roughness: float = Field(default=0.05, ge=0.0"
            }
        },
        missed_by=guards("ground", "water_at_the_ends_of_its_fields[roughness-minimum]"),
    ),
    HardCase(
        "the horizon exactly in the middle",
        Scene(),
        guard="rays that do not point downward miss (surface/march.glsl@plane, surface/march.glsl@march); lengths and "
        "quotients are limited at the horizon (light/shade.glsl@lit)",
        camera=Camera(position=(0.0, 6.0, 0.0), pitch=0.0),
        without={"surface/march.glsl": {"u_eye_height * ray.y >= 0.0": "false"}},
    ),
    HardCase(
        "water as rough as it gets, a hundred kilometres up",
        Scene(water=Water(roughness=0.5, ripples=Ripples(slope=0.6))),
        guard="the unresolved slope variance, which is added to the roughness, is never negative "
        "(waves/ripples.glsl@bands)",
        camera=Camera(position=(0.0, 1e5, 0.0), pitch=-0.3, fov=2.6),
        unseen="not needed: what footprints leave of a band is in [0, 1]",
    ),
)

_BEACH_BELOW = Shore(size=160.0, radius=25.0, depth=6.0, slope=0.1, smoothing=3.0)

_POOL_BELOW = Water(depth=2.0, floor_tile=0.3, ripples=Ripples(slope=0.08))


def _below(**parts: Any) -> Scene:
    return Scene(**{"water": _POOL_BELOW, "light": Light(exposure=-1.5), **parts})


_HARD_BELOW = (
    HardCase(
        "past the critical angle",
        _below(),
        guard="the square of the ray's cosine in air is at least 0 under the root (water/underside.glsl@main)",
        camera=Camera(position=(0.37, -1.2, -0.21), yaw=1.0, pitch=0.35),
        without={"water/underside.glsl": {"sqrt(max(out2, 0.0))": "sqrt(out2)"}},
    ),
    HardCase(
        "straight up, where light and sight fade alike",
        _below(water=_POOL_BELOW.model_copy(update={"ripples": None})),
        guard="1 + fall is at least 1e-3 (water/underside.glsl@water)",
        camera=Camera(position=(0.0, -1.0, 0.0), pitch=math.pi / 2, fov=0.01),
        without={"water/underside.glsl": {"max(1.0 + fall, 1e-3)": "1.0 + fall"}},
    ),
    HardCase(
        "a hair under the surface",
        _below(),
        guard="the distance to the surface is at least 1 mm (water/underside.glsl@main)",
        camera=Camera(position=(0.0, -1e-7, 0.0), pitch=0.3),
        without={"water/underside.glsl": {"max(so_far, 1e-3)": "so_far"}},
    ),
    HardCase(
        "an eye under the floor",
        _below(),
        guard="the distance to the floor is at least 0 (water/seafloor.glsl@reach)",
        camera=Camera(position=(0.0, -5.0, 0.0), pitch=-0.2),
        without={"water/seafloor.glsl": {"max(u_floor_depth + y, 0.0)": "(u_floor_depth + y)"}},
    ),
    HardCase(
        "an eye in a crest, below",
        _below(waves=(ParametricWave(amplitude=0.6, wavelength=5.0, phase=math.pi / 2),), foam=Foam(look="halftone")),
        guard="the distance along the ray is at least 0 (water/underside.glsl@find)",
        camera=Camera(position=(0.0, 0.125, 0.0), pitch=0.1),
        without={
            "water/underside.glsl": {
                "tau = max(u_surface_trough - u_eye_height, 0.0)": "tau = (u_surface_trough - u_eye_height)",
                "tau = max(tau, march_start(ray).r)": "tau = tau",
            }
        },
    ),
    HardCase(
        "straight up from before a beach",
        _below(water=Water(scattering=0.01), shore=_BEACH_BELOW),
        guard="the rate at which a ray approaches the floor is at least 1e-6 (shore/march.glsl@reach)",
        camera=Camera(position=(-42.0, -1.2, 9.0), pitch=math.pi / 2),
        without={
            "shore/march.glsl": {
                "max(u_shore_steepest[0] * level - ray.y, slowest)": "u_shore_steepest[0] * level - ray.y"
            }
        },
    ),
    HardCase(
        "along the slope of a beach, a hand over it",
        _below(water=Water(scattering=0.01), shore=_BEACH_BELOW),
        guard="Newton steps are taken only where the ray approaches the floor (shore/march.glsl@reach)",
        camera=Camera(position=(-60.0, -5.9, 9.0), yaw=1.4, pitch=0.09),
        without={"lib/rays.glsl": {"if (rate < -slowest)": "if (true)"}},
    ),
)

CASES = {
    "water body": Cases(always_visible="it is the water", hard=_HARD),
    "view from below": Cases(
        always_visible="a camera under the surface sees nothing else, and a plan is valid for any camera height",
        hard=_HARD_BELOW,
    ),
}
