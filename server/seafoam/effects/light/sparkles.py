"""Sparkles in the sun's reflection (GPU ocean, 2007). docs/formulae.md, section 12."""

import math

from seafoam.effects.effect import Bound, Contribution, Effect, HardCase, Knob, SlotFile, Source
from seafoam.effects.light.glitter import brightest_glint, smooth_glint
from seafoam.effects.light.noise import HASH
from seafoam.framegraph.rules import Loop, array, number, significant
from seafoam.quality import Quality
from seafoam.scene.models import Camera, Chop, Light, ParametricWave, Scene, Sparkles, Water

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
                "glitter/sparkles.glsl",
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


_SUNSET = Light(sun_elevation=0.12, sun_azimuth=-math.pi / 2, exposure=-1.0, sparkles=Sparkles())
_WATER = Water(chop=Chop(slope=0.2), roughness=0.12)
_VIEW = Camera(position=(0.0, 4.0, 0.0), pitch=-0.1, fov=0.6)


def _light(**fields: object) -> Light:
    return _SUNSET.model_copy(update=fields)


EFFECT = Effect(
    "sparkles",
    contribute,
    invisible=(
        Scene(light=Light(sun_elevation=-0.1, sparkles=Sparkles())),
        Scene(light=Light(sun_elevation=-math.pi / 2, sparkles=Sparkles(rate=0.1, life=0.02), specular="blinn_phong")),
    ),
    knobs=(Knob("/sparkle_cells", "cells that a sample asks for sparkles", (1, 4), "geometry"),),
    hard_cases=(
        HardCase(
            name="sparkles at any time",
            scene=Scene(light=_SUNSET, water=_WATER),
            guard="age and epoch reduced in float64 (framegraph/evaluation.py)",
            without="in float32 at 1e9 s time goes in steps of 64 s: every sparkle stands for a minute",
            times=(-1e9, 0.0, 1e9),
            camera=_VIEW,
        ),
        HardCase(
            name="sparkles straight down, under the sun at the zenith",
            scene=Scene(light=_light(sun_elevation=math.pi / 2), water=_WATER),
            guard="cells on an octahedron, which has no pole (glitter/sparkles.glsl)",
            without="cells of heading and depression: 0.3 by 3.2 mrad a tenth of a radian from straight down",
            camera=Camera(position=(0.0, 4.0, 0.0), pitch=-math.pi / 2),
        ),
        HardCase(
            name="one sparkle for the whole sun",
            scene=Scene(
                light=_light(sparkles=Sparkles(size=2e-4, rate=0.3, life=0.3, share=1.0), exposure=10.0), water=_WATER
            ),
            guard="light held at 65504 (surface/main.glsl)",
            without="5.2e7, eight hundred times what half floats hold",
            times=(0.0, 0.13),
            camera=_VIEW.model_copy(update={"fov": 0.02}),
        ),
        HardCase(
            name="sparkles so many that they run together",
            scene=Scene(light=_light(sparkles=Sparkles(size=0.02, rate=10000.0, life=10.0)), water=_WATER),
            guard="where nearly every cell is alight the glint is smooth (glitter/sparkles.glsl)",
            without="spots of 22 times the glint's greatest light: off by 7.2 levels in the mean",
            camera=_VIEW,
        ),
        HardCase(
            name="sparkles of a sun that sets through the horizon",
            scene=Scene(
                waves=(ParametricWave(amplitude=0.3, wavelength=7.0),), light=_light(sun_elevation=0.0), water=_WATER
            ),
            guard="a glint of at least 1e-20 of the sun (glitter/sparkles.glsl)",
            without="0/0 where facets mirror no sun: 65504 in 39 % of samples",
            camera=_VIEW,
        ),
        HardCase(
            name="sparkles smaller than a hundredth of a pixel",
            scene=Scene(light=_light(sparkles=Sparkles(size=2e-4)), water=_WATER),
            guard="a sparkle is never narrower than a pixel and a half, and dimmer by as much (glitter/sparkles.glsl)",
            without="sparkles seen or not by where samples fall: up to 170 levels off",
            camera=Camera(position=(0.0, 4.0, 0.0), pitch=-0.5, fov=2.6),
        ),
    ),
)
