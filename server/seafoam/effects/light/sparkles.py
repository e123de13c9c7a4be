"""Sparkles in the sun's reflection (GPU ocean, 2007). docs/formulae.md, section 12."""

import math

from seafoam.effects.effect import Bound, Contribution, QualityParameter, part_effect
from seafoam.effects.light.glitter import brightest_glint, smooth_glint
from seafoam.effects.shader import HASH, SlotFile, Source
from seafoam.framegraph.rules import Loop, array, number, significant
from seafoam.quality import Quality
from seafoam.scene.light import Light, Sparkles
from seafoam.scene.models import Scene

EPOCHS = 65536
"""Period of the sparkles, in lifetimes: five hours at the default."""
_SQUARE_DEGREES = (180.0 / math.pi) ** 2


def density(sparkles: Sparkles) -> float:
    """Return simultaneous sparkles per steradian where the glint's radiance is the sun's irradiance / sr."""
    return math.pi * sparkles.rate * _SQUARE_DEGREES * sparkles.life


def _draw(scene: Scene, light: Light, sparkles: Sparkles, quality: Quality) -> Contribution:
    radius = 0.5 * sparkles.size
    # Up to four sparkles overlap, each with up to 1.9 times its mean brightness in the middle of its life.
    peak = 4.0 * 1.9 / (math.pi / 3.0 * radius * radius * density(sparkles))
    path, needs, uniforms = smooth_glint(light)
    smooth = Source(path, (("glitter_light", "smooth_glitter"),))
    return Contribution(
        why=f"sparkles of {1e3 * sparkles.size:g} mrad that last {sparkles.life:g} s",
        slots=(SlotFile("glitter", "light/glitter.glsl@sparkles", needs=(*needs, HASH, smooth), instead=True),),
        consts={"SPARKLE_CELLS": quality.sparkle_cells},
        uniforms={
            **uniforms,
            "u_sparkle_radius": number(significant(radius)),
            "u_sparkle_density": number(significant(density(sparkles))),
            "u_sparkle_share": number(sparkles.share, "/light/sparkles/share"),
            "u_sparkle_life": number(sparkles.life),
            "u_sparkle_time": array("float", [Loop(period=sparkles.life), Loop(period=sparkles.life * EPOCHS)], 2),
        },
        bound=Bound(
            brightest_glint(scene) * max(peak, 1.0),
            "the lamp is below the horizon",
            ("/light/exposure", "/water/roughness"),
        ),
    )


EFFECT = part_effect(
    "sparkles",
    _draw,
    "/light/sparkles",
    parameters=(QualityParameter("/sparkle_cells", "sparkle cells per sample", (1, 4), "geometry"),),
)
