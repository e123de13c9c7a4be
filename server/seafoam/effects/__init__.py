"""The effects, in the order in which they contribute: each is a module here, its GLSL, and a line below.

Effects describe what a plan needs. They draw nothing, and import neither the planner nor an executor.
"""

from seafoam.effects.boats import boat, wake
from seafoam.effects.effect import Effect
from seafoam.effects.foam import drift, front, height, living, look, material, slope, surf, wake_foam, whitecaps
from seafoam.effects.light import cloud_shadow, clouds, glare, glitter, light, night, sparkles, subsurface
from seafoam.effects.reflection import cubemap, planar
from seafoam.effects.registry import declare, load, outside, register, unregister
from seafoam.effects.shore import shadow, shore
from seafoam.effects.spray import spray
from seafoam.effects.water import caustics, seafloor, water
from seafoam.effects.waves import current, parametric, rings, ripples, sea, standing, touch

EFFECTS: tuple[Effect, ...] = (
    parametric.EFFECT,
    sea.EFFECT,
    rings.EFFECT,
    wake.EFFECT,
    ripples.EFFECT,
    front.EFFECT,
    height.EFFECT,
    slope.EFFECT,
    whitecaps.EFFECT,
    look.EFFECT,
    living.EFFECT,
    light.EFFECT,
    clouds.CIRRUS,
    clouds.EFFECT,
    cloud_shadow.EFFECT,
    night.MOON,
    night.STARS,
    glare.EFFECT,
    glitter.EFFECT,
    sparkles.EFFECT,
    water.EFFECT,
    seafloor.EFFECT,
    caustics.EFFECT,
    water.UNDERSIDE,
    shore.EFFECT,
    shadow.EFFECT,
    surf.EFFECT,
    cubemap.EFFECT,
    drift.EFFECT,
    subsurface.EFFECT,
    material.AERATION,
    material.RELIEF,
    material.SCATTERING,
    wake_foam.EFFECT,
    boat.EFFECT,
    spray.EFFECT,
    boat.SHADOWS,
    planar.EFFECT,
    current.EFFECT,
    standing.EFFECT,
    touch.EFFECT,
)
"""All effects of the package."""

for _effect in EFFECTS:
    declare(_effect)
load()

__all__ = ["EFFECTS", "outside", "register", "unregister"]
