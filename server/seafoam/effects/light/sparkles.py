"""Sparkles in the sun's reflection (GPU ocean, 2007). docs/formulae.md, section 12."""

import math

from seafoam.effects.effect import Bound, Contribution, Effect, Knob, SlotFile, Source
from seafoam.effects.light.glitter import brightest_glint, smooth_glint
from seafoam.effects.noise import HASH
from seafoam.framegraph.rules import Loop, array, number, significant
from seafoam.quality import Quality
from seafoam.scene.light import Sparkles
from seafoam.scene.models import Scene

EPOCHS = 65536
"""After so many lives the sparkles repeat: five hours at the default."""
_SQUARE_DEGREES = (180.0 / math.pi) ** 2


def density(sparkles: Sparkles) -> float:
    """Sparkles alight at once in a steradian where the glint's radiance is the sun's irradiance a steradian."""
    return math.pi * sparkles.rate * _SQUARE_DEGREES * sparkles.life


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by ``light.sparkles``."""
    light = scene.light
    if light is None or light.sparkles is None:
        return None
    sparkles = light.sparkles
    radius = 0.5 * sparkles.size
    # Four may lie over one another, each in the middle of its life at 1.9 times its mean.
    peak = 4.0 * 1.9 / (math.pi / 3.0 * radius * radius * density(sparkles))
    path, needs, uniforms = smooth_glint(light)
    smooth = Source(path, (("glitter_light", "smooth_glitter"),))
    return Contribution(
        why=f"sparks of {1e3 * sparkles.size:g} mrad for {sparkles.life:g} s",
        slots=(
            SlotFile(
                "glitter",
                "light/glitter/sparkles.glsl",
                needs=(*needs, HASH, smooth),
            ),
        ),
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
            brightest_glint(scene) * max(peak, 1.0), "the sun is down", ("/light/exposure", "/water/roughness")
        ),
    )


EFFECT = Effect(
    "sparkles",
    contribute,
    knobs=(Knob("/sparkle_cells", "sparkle cells per sample", (1, 4), "geometry"),),
)
