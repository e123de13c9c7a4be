"""The effects, in the order in which they are asked. A new effect is one module here, its GLSL, and a line below."""

from seafoam.effects import (
    chop,
    clouds,
    crest,
    cubemap,
    drift,
    floor,
    foam_look,
    fold,
    front,
    glitter,
    height,
    light,
    night,
    parametric,
    rings,
    sea,
    shore,
    slope,
    sparkles,
    spray,
    surf,
    water,
)
from seafoam.effects.contribution import Effect

EFFECTS: tuple[Effect, ...] = (
    parametric.EFFECT,
    sea.EFFECT,
    rings.EFFECT,
    chop.EFFECT,
    front.EFFECT,
    height.EFFECT,
    slope.EFFECT,
    fold.EFFECT,
    foam_look.EFFECT,
    light.EFFECT,
    clouds.EFFECT,
    night.MOON,
    night.STARS,
    glitter.EFFECT,
    sparkles.EFFECT,
    water.EFFECT,
    floor.EFFECT,
    shore.EFFECT,
    surf.EFFECT,
    cubemap.EFFECT,
    drift.EFFECT,
    crest.EFFECT,
    spray.EFFECT,
)
"""Every effect there is."""

__all__ = ["EFFECTS"]
