"""The effects, in the order in which they contribute: each is a module here, its GLSL, and a line below.

Effects describe what a plan needs. They draw nothing, and import neither the planner nor an executor.
"""

from seafoam.effects.boats import boat, wake
from seafoam.effects.effect import Effect
from seafoam.effects.foam import drift, front, look, material, sources, whitecaps
from seafoam.effects.light import clouds, glitter, light, reflection
from seafoam.effects.registry import declare, load, outside, register
from seafoam.effects.shore import shore
from seafoam.effects.spray import spray
from seafoam.effects.water import caustics, water
from seafoam.effects.waves import boulders, breaker, current, parametric, rings, ripples, sea

EFFECTS: tuple[Effect, ...] = (
    parametric.EFFECT,
    sea.EFFECT,
    rings.EFFECT,
    wake.EFFECT,
    ripples.EFFECT,
    front.EFFECT,
    sources.HEIGHT,
    sources.SLOPE,
    whitecaps.EFFECT,
    look.EFFECT,
    look.LIVING,
    light.EFFECT,
    clouds.CIRRUS,
    clouds.EFFECT,
    clouds.SHADOWS,
    light.MOON,
    light.STARS,
    glitter.GLARE,
    glitter.GLITTER,
    glitter.SPARKLES,
    water.EFFECT,
    water.FLOOR,
    caustics.EFFECT,
    water.UNDERSIDE,
    shore.EFFECT,
    shore.SHADOWS,
    sources.SURF,
    reflection.CUBEMAP,
    drift.EFFECT,
    water.CREST_LIGHT,
    material.AERATION,
    material.RELIEF,
    material.SCATTERING,
    sources.WAKE,
    boat.EFFECT,
    breaker.EFFECT,
    spray.EFFECT,
    boat.SHADOWS,
    reflection.PLANAR,
    current.EFFECT,
    current.STANDING_WAVES,
    boulders.EFFECT,
    rings.TOUCHES,
)
"""All effects of the package."""

for _effect in EFFECTS:
    declare(_effect)
load()

__all__ = ["EFFECTS", "outside", "register"]
