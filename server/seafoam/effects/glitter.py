"""The sun's glitter on the water, and its disc in the sky. docs/formulae.md, section 6."""

import math

from seafoam.effects.contribution import Bound, Contribution, Effect, SlotFile, vector
from seafoam.effects.light import sun_disc, sun_irradiance
from seafoam.quality import Quality
from seafoam.scene.models import Light, Scene

_DOWN = Light(sun_elevation=-0.1)


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by ``light``."""
    light = scene.light
    if light is None:
        return None
    # The peak of the mirror's lobe: all facets alike, seen at grazing, where cv is the roughness itself; the factor 4
    # covers the lobe of a surface made rough by its filtered waves.
    sigma = scene.water.roughness
    brightest = max(sun_irradiance(light)) * 2.0**light.exposure
    return Contribution(
        why="the sun is up",
        slots=(
            SlotFile("glitter", "glitter/beckmann.glsl", needs=("shade/fresnel.glsl", "shade/sun.glsl")),
            SlotFile("disc", "sky/sun_disc.glsl"),
        ),
        uniforms={"u_sun_disc": vector(sun_disc(light))},
        bound=Bound(
            brightest * max(1.0 / (math.pi * sigma**3), 1.0 / 6.8e-5),
            "the sun is down",
            ("/light/exposure", "/water/roughness"),
        ),
    )


EFFECT = Effect(
    "sun glitter",
    contribute,
    invisible=(Scene(light=_DOWN), Scene(light=Light(sun_elevation=-math.pi / 2))),
)
