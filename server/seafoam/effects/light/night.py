"""The moon and the stars. docs/formulae.md, section 9."""

import math

from seafoam.effects.effect import Bound, Contribution, Effect, HardCase, SlotFile
from seafoam.effects.light import atmosphere
from seafoam.effects.light.noise import HASH, PERLIN_2
from seafoam.framegraph.rules import number, significant, vector
from seafoam.quality import Quality
from seafoam.scene.models import Camera, Chop, Light, Scene, Water
from seafoam.scene.sky import Moon, Sky

STAR_POWER = 1.0


def _rounded(values: tuple[float, ...]) -> tuple[float, ...]:
    return tuple(significant(value) for value in values)


def moon(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by ``light.sky.moon``."""
    light = scene.light
    if light is None or light.sky is None or light.sky.moon is None:
        return None
    of = light.sky.moon
    toward = atmosphere.moon(light)
    assert toward is not None
    sun = atmosphere.sun(light)
    right = (-math.sin(of.azimuth), 0.0, math.cos(of.azimuth))
    up = (
        -math.sin(of.elevation) * math.cos(of.azimuth),
        math.cos(of.elevation),
        -math.sin(of.elevation) * math.sin(of.azimuth),
    )
    radius = atmosphere.MOON_RADIUS * of.size
    face = atmosphere.MOON_FACE * atmosphere.MOON_POWER * of.brightness
    lit = 100.0 * math.sqrt(atmosphere.moon_phase(light))
    return Contribution(
        why=f"moon {math.degrees(of.elevation):.0f}° over the horizon, {lit:.0f} % lit",
        slots=(
            SlotFile("moon", "sky/moon_glow.glsl"),
            SlotFile("moon disc", "sky/moon_disc.glsl", needs=PERLIN_2),
        ),
        uniforms={
            "u_moon_direction": vector(_rounded(toward)),
            "u_moon_path": vector(_rounded(atmosphere.path(light, toward[1]))),
            "u_moon_power": vector(_rounded(atmosphere.moon_power(light))),
            "u_moon_right": vector(_rounded(right)),
            "u_moon_up": vector(_rounded(up)),
            "u_moon_radius": number(significant(radius)),
            "u_moon_sun": vector(
                _rounded(
                    tuple(
                        sum(a * b for a, b in zip(sun, axis, strict=True))
                        for axis in (right, up, tuple(-value for value in toward))
                    )
                )
            ),
            "u_moon_radiance": vector(
                _rounded(
                    tuple(
                        face * tint * math.exp(-0.5 * tau)
                        for tint, tau in zip(atmosphere.MOON_TINT, atmosphere.path(light, toward[1]), strict=True)
                    )
                )
            ),
        },
        bound=Bound(0.0, "the moon is down") if toward[1] < -max(0.02, 2.0 * radius) else None,
    )


def stars(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by ``light.sky.stars``."""
    light = scene.light
    if light is None or light.sky is None or light.sky.stars == 0.0:
        return None
    dark = atmosphere.smooth(0.05, 0.2, -atmosphere.sun(light)[1])
    return Contribution(
        why="stars",
        slots=(SlotFile("stars", "sky/stars.glsl", needs=("common/cube_face.glsl", HASH)),),
        uniforms={
            "u_star_path": vector(_rounded(tuple(tau + atmosphere.mie_depth(light) for tau in atmosphere.RAYLEIGH))),
            "u_star_brightness": number(significant(STAR_POWER * light.sky.stars * dark)),
        },
        bound=Bound(0.0, "the sun is up") if dark == 0.0 else None,
    )


_OPPOSITE = Moon(azimuth=0.3 - math.pi, elevation=0.4, size=5.0)
_BEFORE = Moon(azimuth=0.3, elevation=0.4, size=5.0)

MOON = Effect(
    "moon",
    moon,
    invisible=(Scene(light=Light(sun_elevation=-0.3, sky=Sky(moon=Moon(elevation=-0.2)))),),
    hard_cases=(
        HardCase(
            name="moon and sun opposite",
            scene=Scene(
                light=Light(sun_azimuth=0.3, sun_elevation=-0.4, exposure=1.0, sky=Sky(moon=_OPPOSITE)),
                water=Water(chop=Chop()),
            ),
            guard="the ball's height at its rim is the root of at least 0 (sky/moon_disc.glsl)",
            without="nothing on llvmpipe, whose max(NaN, 0) is 0: NaN in a ring of a twentieth of the disc",
            camera=Camera(position=(0.0, 3.0, 0.0), yaw=0.3 - math.pi / 2, pitch=0.35, fov=0.2),
        ),
        HardCase(
            name="the moon before the sun",
            scene=Scene(
                light=Light(sun_azimuth=0.3, sun_elevation=0.4, exposure=-6.0, sky=Sky(moon=_BEFORE)),
            ),
            guard="a face that is turned from the sun gets at least no light (sky/moon_disc.glsl)",
            without="the root of a negative number: the face blows up to 65504, 229 levels off",
            camera=Camera(position=(0.0, 3.0, 0.0), yaw=0.3 + math.pi / 2, pitch=0.4, fov=0.3),
        ),
    ),
)
STARS = Effect(
    "stars",
    stars,
    invisible=(Scene(light=Light(sun_elevation=0.1, sky=Sky(stars=1.0))),),
    hard_cases=(
        HardCase(
            name="stars at the corner of the cube",
            scene=Scene(light=Light(sun_elevation=-1.0, exposure=6.0, sky=Sky(stars=10.0))),
            guard="cells counted up to the last of a face (sky/stars.glsl)",
            without="nothing seen: only a sample exactly on a face's rim asks for a cell beyond it",
            camera=Camera(position=(0.0, 3.0, 0.0), yaw=math.pi / 4, pitch=0.6154797, fov=0.6),
        ),
        HardCase(
            name="stars in the widest view",
            scene=Scene(light=Light(sun_elevation=-1.0, exposure=6.0, sky=Sky(stars=10.0))),
            guard="a star is 3e-3 rad wide at most (sky/stars.glsl)",
            without="stars cut off at the sides of their cells: 7 % of samples off by more than 2 levels",
            camera=Camera(position=(0.0, 3.0, 0.0), yaw=0.5, pitch=0.8, fov=2.6),
        ),
    ),
)
