"""The body of the water: absorption, scattering, roughness. docs/formulae.md, section 6."""

from seafoam.effects.effect import Contribution, Effect
from seafoam.framegraph.rules import Uniform, number, vector
from seafoam.quality import Quality
from seafoam.scene.models import (
    Scene,
)


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Active if the scene has a light."""
    if scene.light is None:
        return None
    water = scene.water
    uniforms: dict[str, Uniform] = {
        "u_absorption_length": vector(water.absorption_length, "/water/absorption_length"),
        "u_scattering": number(water.scattering, "/water/scattering"),
        "u_roughness": number(water.roughness, "/water/roughness"),
    }
    return Contribution(why="the water absorbs and scatters light", uniforms=uniforms)


EFFECT = Effect("water body", contribute, fields=("/water",))
