"""Test scenes of the water's body, floor and caustics: hard cases, and scenes that cannot show them."""

import math
from itertools import product
from typing import Any

from support.cases import Cases, HardCase, reduced
from support.scenes import Camera, Caustics, Foam, HeightSaturation, Light, ParametricWave, Ripples, Scene, Shore, Water

_HARD_WATER = (
    HardCase(
        "eye on the surface",
        Scene(foam=Foam(saturation=(HeightSaturation(base=-1.0, full=1.0),), look="halftone")),
        guard="the distance along the ray is at least 0 (surface/march.glsl@plane, surface/march.glsl@march)",
        camera=Camera(position=(0.0, 0.0, 0.0), pitch=-0.3),
        without={"surface/march.glsl": {"u_eye_height * ray.y >= 0.0": "ray.y >= 0.0"}},
    ),
    HardCase(
        "the horizon exactly in the middle",
        Scene(),
        guard="rays that do not point downward miss (surface/march.glsl@plane, surface/march.glsl@march); lengths and "
        "quotients are limited at the horizon (light/shade.glsl@lit)",
        camera=Camera(position=(0.0, 6.0, 0.0), pitch=0.0),
        without={"surface/march.glsl": {"u_eye_height * ray.y >= 0.0": "false"}},
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
        without={"water/underside.glsl": {"max(reach, 1e-3)": "reach"}},
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

_INVISIBLE_SEAFLOOR = (
    Scene(water=Water(depth=11000.0)),
    Scene(waves=(ParametricWave(),), water=Water(depth=500.0, ripples=Ripples())),
)

_PLAIN = Caustics(dispersion=0.0)

_LIGHT = Light(sun_elevation=1.0, exposure=-2.5, caustics=_PLAIN)

_DEEP = Water(depth=900.0, ripples=Ripples())

_DOWN = Camera(position=(0.0, 2.0, 0.0), pitch=-1.2)


_INVISIBLE_CAUSTICS = (
    Scene(water=_DEEP, light=Light(caustics=Caustics())),
    Scene(water=Water(depth=2.0, ripples=Ripples()), light=Light(sun_elevation=-0.3, caustics=Caustics())),
)

_HARD_CAUSTICS = (
    HardCase(
        "caustics of a sun on the horizon",
        Scene(water=Water(depth=1.0, ripples=Ripples(slope=0.1)), light=Light(sun_elevation=0.0, caustics=_PLAIN)),
        guard="the sine of the sun's elevation is at least 0.05 (water/caustics.glsl@landing)",
        times=(2.0,),
        camera=_DOWN,
        without={"water/caustics.glsl": {"max(u_sun_direction.y, 0.05)": "u_sun_direction.y"}},
    ),
    HardCase(
        "caustics of the steepest ripples",
        Scene(
            water=Water(depth=3.0, ripples=Ripples(slope=0.6)),
            light=Light(sun_elevation=0.1, exposure=-1.0, caustics=_PLAIN),
        ),
        guard="the cosine between a refracted ray and the vertical is at least 0.25 (water/caustics.glsl@landing)",
        times=(2.0,),
        camera=_DOWN,
        without={"water/caustics.glsl": {"max(-ray.y, 0.25)": "-ray.y"}},
    ),
    reduced(
        "caustics after thirty years, ten thousand kilometres away",
        Scene(water=Water(depth=2.0, floor_tile=0.3, ripples=Ripples(slope=0.06)), light=_LIGHT),
        "phases and the camera's position in the tile",
        Camera(position=(-1e7, 2.0, 1e7), pitch=-1.2),
        times=(1e9,),
    ),
)

_VARIANTS = tuple(
    Scene(
        water=Water(depth=2.0, floor_tile=tile, view_below=below, ripples=Ripples()),
        light=Light(caustics=Caustics(dispersion=dispersion)),
    )
    for dispersion, tile, below in product((0.0, 1.0), (None, 0.3), (False, True))
)

CASES = {
    "water body": Cases(always_visible="it is the water", hard=_HARD_WATER),
    "view from below": Cases(
        always_visible="a camera under the surface sees nothing else, and a plan is valid for any camera height",
        hard=_HARD_BELOW,
    ),
    "floor": Cases(invisible=_INVISIBLE_SEAFLOOR),
    "caustics": Cases(invisible=_INVISIBLE_CAUSTICS, hard=_HARD_CAUSTICS, variants=_VARIANTS),
}
