"""Hard cases of water.water, and scenes that call for it and cannot show it."""

from seafoam.scene.camera import Camera
from seafoam.scene.foam import Foam, HeightSaturation
from seafoam.scene.models import Scene
from seafoam.scene.water import Ripples, Water
from support.cases import Cases, HardCase

_HARD = (
    HardCase(
        "eye on the surface",
        Scene(foam=Foam(saturation=(HeightSaturation(base=-1.0, full=1.0),), look="halftone")),
        guard="the distance along the ray is at least 0 (surface/march.glsl@plane, surface/march.glsl@march)",
        without="every ray hits the surface at the camera itself: a mean error of 182 levels",
        camera=Camera(position=(0.0, 0.0, 0.0), pitch=-0.3),
    ),
    HardCase(
        "no scattering, no roughness to speak of",
        Scene(water=Water(scattering=0.0, roughness=0.01, absorption_length=(0.01, 1000.0, 0.01))),
        guard="the roughness is at least 0.01 (scene/water.py), which keeps the cosine of incidence above 0 "
        "(light/shade.glsl@lit)",
        without="with roughness 0 glitter is divided by 0: a mean error of 96 levels",
        camera=Camera(position=(0.0, 0.5, 0.0), pitch=0.0),
    ),
    HardCase(
        "the horizon exactly in the middle",
        Scene(),
        guard="rays that do not point downward miss (surface/march.glsl@plane, surface/march.glsl@march); lengths and "
        "quotients are limited at the horizon (light/shade.glsl@lit)",
        without="infinite and negative distances in the middle row, 1.8 % of samples; rays that point upward hit "
        "water behind the camera",
        camera=Camera(position=(0.0, 6.0, 0.0), pitch=0.0),
    ),
    HardCase(
        "water as rough as it gets, a hundred kilometres up",
        Scene(water=Water(roughness=0.5, ripples=Ripples(slope=0.6))),
        guard="the unresolved slope variance, which is added to the roughness, is never negative "
        "(waves/ripples.glsl@bands)",
        without="no difference on llvmpipe: the resolved fractions are in [0, 1]",
        camera=Camera(position=(0.0, 1e5, 0.0), pitch=-0.3, fov=2.6),
    ),
)

CASES = {"water body": Cases(always_visible="it is the water", hard=_HARD)}
