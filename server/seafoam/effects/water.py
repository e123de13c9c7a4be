"""The body of the water: absorption, scattering, floor, thin crests. docs/formulae.md, section 6."""

from seafoam.effects.contribution import Contribution, Effect, SlotFile, Uniform, number, vector
from seafoam.quality import Quality
from seafoam.scene.models import Scene


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for wherever there is light."""
    if scene.light is None:
        return None
    water = scene.water
    top = sum(wave.amplitude for wave in scene.waves)
    uniforms: dict[str, Uniform] = {
        "u_absorption_length": vector(water.absorption_length, "/water/absorption_length"),
        "u_scattering": number(water.scattering, "/water/scattering"),
        "u_translucency": number(water.translucency, "/water/translucency"),
        "u_roughness": number(water.roughness, "/water/roughness"),
        "u_crest_height": number(1.0 / top if top > 0.0 else 0.0),
    }
    if water.depth is None:
        return Contribution(why="deep water", slots=(SlotFile("body", "body/deep.glsl"),), uniforms=uniforms)
    return Contribution(
        why=f"water over a floor {water.depth:g} m under the troughs",
        slots=(SlotFile("body", "body/floor.glsl"),),
        uniforms={
            **uniforms,
            "u_floor_albedo": vector(water.floor_albedo, "/water/floor_albedo"),
            "u_floor_depth": number(water.depth),
        },
    )


EFFECT = Effect("water body", contribute)
