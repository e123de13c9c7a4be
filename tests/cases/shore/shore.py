"""Hard cases of shore.shore, and scenes that name it but in which it is invisible."""

import math
from dataclasses import replace

from support.cases import Cases, HardCase
from support.scenes import Camera, Foam, Light, Ripples, Scene, Shore, Surf, SurfSaturation, Water

_FOAM = Foam(saturation=(SurfSaturation(),), mask="clump")

_LIGHT = Light(sun_elevation=0.7, sun_azimuth=2.0, exposure=-2.0)

_VIEW = Camera(position=(-42.0, 7.0, 9.0), yaw=1.4, pitch=-0.2)

_SMALL = Shore(size=160.0, radius=25.0, depth=6.0, slope=0.1, smoothing=3.0)


def _case(
    name: str,
    guard: str,
    camera: Camera = _VIEW,
    water: Water | None = None,
    foam: Foam | None = _FOAM,
    times: tuple[float, ...] = (0.0,),
    **fields: object,
) -> HardCase:
    scene = Scene(
        shore=_SMALL.model_copy(update=fields), water=water or Water(scattering=0.01), foam=foam, light=_LIGHT
    )
    return HardCase(name, scene, guard=guard, camera=camera, times=times)


_INVISIBLE = (Scene(shore=Shore(depth=50.0, level=-900.0)), Scene(shore=Shore(level=-900.0), light=None))

_HARD = (
    _case(
        "distances without any smoothing",
        "standard deviation of the blur at least 0.01 texel (shore/maps.glsl@blur)",
        smoothing=0.0,
    ),
    _case(
        "all land",
        "gradients divided by at least 1e-6; distance to the coast at most the side of the square "
        "(shore/maps.glsl@map, shore/maps.glsl@distance)",
        level=90.0,
        camera=Camera(position=(-42.0, 107.0, 9.0), yaw=1.4, pitch=-0.3),
    ),
    _case(
        "all water, a bank two metres down",
        "distance to the coast at most the side of the square (shore/maps.glsl@distance)",
        kind="island",
        height=0.0,
        level=-2.0,
    ),
    _case(
        "an island of one texel",
        "wave height 0 on ridges of the distance map (shore/maps.glsl@map)",
        kind="island",
        radius=1.0,
        smoothing=0.5,
        height=0.5,
        slope=0.4,
    ),
    _case(
        "water a hand deep and a beach as level",
        "depths and speeds as for waves of at least 5 cm (shore/maps.glsl@map)",
        depth=0.5,
        slope=0.01,
        height=0.1,
        surf=Surf(height=0.0),
    ),
    _case(
        "waves of no skew and of all of it",
        "profiles from a table, smoothed, with the highest branch where they overhang (textures/shore.py)",
        surf=Surf(height=2.0, skew=0.0, sharpness=0.15),
        times=(0.0, 2.3),
        camera=Camera(position=(-42.0, 9.0, 9.0), yaw=1.4, pitch=-0.25),
    ),
    _case(
        "the clearest water",
        "absorption is never 0 (scene/water.py)",
        water=Water(absorption_length=(1000.0, 1000.0, 1000.0), scattering=0.0),
    ),
    _case(
        "ripples that face away",
        "the refracted ray's direction has y of at most -0.25 (shore/floor.glsl@through)",
        water=Water(ripples=Ripples(slope=0.6), scattering=0.01),
        camera=Camera(position=(-42.0, 2.2, 9.0), yaw=1.4, pitch=-0.05),
    ),
    _case(
        "straight down on the water's edge",
        "horizontal part of the ray at least 1e-9 (shore/march.glsl@march)",
        camera=Camera(position=(-1.0, 30.0, 0.0), pitch=-math.pi / 2, fov=0.5),
    ),
    _case(
        "a shore ten thousand kilometres away, after thirty years",
        "position and time reduced in float64 (framegraph/evaluation.py)",
        place=(-9999900.0, 9999900.0),
        camera=Camera(position=(-9999942.0, 7.0, 9999909.0), yaw=1.4, pitch=-0.2),
        times=(-1e9, 1e9),
    ),
    _case(
        "a swell that the depth bends, over a beach all but level",
        "speeds as over at least 5 cm of water, on land as well (ocean/coast/travel.py)",
        kind="island",
        slope=0.02,
        surf=Surf(height=0.1, period=2.0, exposure=1.0, refraction=True),
        times=(0.0, 1e9),
    ),
    _case(
        "rugged land of full detail, seen along the ground",
        "footprints of no width are taken as 1e-9 m wide; octaves under them as whole (shore/soil.glsl@soil)",
        relief=1.0,
        height=60.0,
        slope=1.0,
        plants_from=0.0,
        camera=Camera(position=(-42.0, 2.0, 9.0), yaw=1.4, pitch=0.1),
    ),
    _case(
        "smooth land",
        "none needed: without detail neither octaves nor a film of water are in the program (effects/shore/land.py)",
        detail=0.0,
    ),
    replace(
        _case(
            "eye inside a hill",
            "the distance to land is at least 0 (shore/march.glsl@march)",
            camera=Camera(position=(40.0, 0.5, 0.0), yaw=1.4, pitch=0.1),
        ),
        apart="the reference looks for the hill from its inside, the march takes the eye's own place",
    ),
    replace(
        _case(
            "eye under water",
            "a search interval with its end before its start has no intersection (shore/land.glsl@find_land)",
            camera=Camera(position=(-30.0, -1.0, 0.0), yaw=1.4, pitch=0.1),
        ),
        apart="the reference looks for the surface from below, the march takes the eye's own place",
    ),
)

_SMOOTH = Scene(shore=_SMALL.model_copy(update={"detail": 0.0}), foam=_FOAM, light=_LIGHT)

CASES = {"shore": Cases(invisible=_INVISIBLE, hard=_HARD, variants=(_SMOOTH,))}
