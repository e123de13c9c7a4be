"""The effects, in the order in which they are asked. A new effect is one module here, its GLSL, and a line below."""

from seafoam.effects import (
    below,
    caustics,
    chop,
    crest,
    floor,
    foam_look,
    fold,
    front,
    glitter,
    height,
    light,
    parametric,
    rings,
    sea,
    shore,
    slope,
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
    glitter.EFFECT,
    water.EFFECT,
    floor.EFFECT,
    caustics.EFFECT,
    below.EFFECT,
    shore.EFFECT,
    surf.EFFECT,
    crest.EFFECT,
)
"""Every effect there is."""

__all__ = ["EFFECTS"]
