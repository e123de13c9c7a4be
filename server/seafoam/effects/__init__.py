"""The effects, in the order in which they are asked. A new effect is one module here, its GLSL, and a line below."""

from seafoam.effects import (
    boat,
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
    planar,
    rings,
    sea,
    shore,
    slope,
    surf,
    wake,
    wake_foam,
    water,
)
from seafoam.effects.contribution import Effect

EFFECTS: tuple[Effect, ...] = (
    parametric.EFFECT,
    sea.EFFECT,
    rings.EFFECT,
    wake.EFFECT,
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
    shore.EFFECT,
    surf.EFFECT,
    wake_foam.EFFECT,
    crest.EFFECT,
    boat.EFFECT,
    planar.EFFECT,
)
"""Every effect there is."""

__all__ = ["EFFECTS"]
