"""The moon and the stars. docs/formulae.md, section 9."""

import math

import numpy as np

from seafoam.effects.effect import Bound, Contribution, part_effect
from seafoam.effects.light import atmosphere
from seafoam.effects.light.light import glow_source, glow_uniforms
from seafoam.effects.shader import HASH, PERLIN_2, SlotFile
from seafoam.framegraph.rules import number, rounded, significant, vector
from seafoam.ocean.arrays import smooth
from seafoam.quality import Quality
from seafoam.scene.light import Light, Moon, Sky
from seafoam.scene.models import Scene
from seafoam.sums import summed

STAR_POWER = 1.0
"""Brightness of the brightest stars at night."""


def _moon(scene: Scene, light: Light, sky: Sky, model: Moon, quality: Quality) -> Contribution:
    toward = atmosphere.moon(light)
    assert toward is not None
    sun = atmosphere.sun(light)
    right = (-math.sin(model.azimuth), 0.0, math.cos(model.azimuth))
    rise, level = math.sin(model.elevation), math.cos(model.elevation)
    up = (-rise * math.cos(model.azimuth), level, -rise * math.sin(model.azimuth))
    radius = atmosphere.MOON_RADIUS * model.size
    face = atmosphere.MOON_FACE * atmosphere.MOON_POWER * model.brightness * atmosphere.MOON_TINT
    axes = (right, up, tuple(-value for value in toward))
    glows = atmosphere.glows(light)
    lit = 100.0 * math.sqrt(atmosphere.moon_phase(light))
    return Contribution(
        why=f"moon {math.degrees(model.elevation):.0f}° above the horizon, {lit:.0f} % illuminated",
        slots=(
            *((SlotFile("moon", glow_source("moon")),) if "moon" in glows else ()),
            SlotFile("moon disc", "light/night.glsl@moon_disc", needs=PERLIN_2),
        ),
        uniforms={
            "u_moon_direction": vector(rounded(toward)),
            **(glow_uniforms("moon", *glows["moon"]) if "moon" in glows else {}),
            "u_moon_right": vector(rounded(right)),
            "u_moon_up": vector(rounded(up)),
            "u_moon_radius": number(significant(radius)),
            "u_moon_sun": vector(rounded(summed(a * b for a, b in zip(sun, axis, strict=True)) for axis in axes)),
            "u_moon_radiance": vector(rounded(face * np.exp(-0.5 * atmosphere.path(light, toward[1])))),
        },
        bound=Bound.zero_if(toward[1] < -max(0.02, 2.0 * radius), "the moon is below the horizon"),
    )


def _stars(scene: Scene, light: Light, sky: Sky, brightness: float, quality: Quality) -> Contribution:
    dark = smooth(0.05, 0.2, -atmosphere.sun(light)[1])
    return Contribution(
        why="stars",
        slots=(SlotFile("stars", "light/night.glsl@stars", needs=("lib/texels.glsl@cube_face", HASH)),),
        uniforms={
            "u_star_path": vector(rounded(atmosphere.RAYLEIGH + atmosphere.mie_depth(light))),
            "u_star_brightness": number(significant(STAR_POWER * brightness * dark)),
        },
        bound=Bound.zero_if(dark == 0.0, "the sun is above the horizon"),
    )


MOON = part_effect("moon", _moon, "/light/sky/moon")
STARS = part_effect("stars", _stars, "/light/sky/stars")
