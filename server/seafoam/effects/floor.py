"""The floor under shallow water. docs/formulae.md, section 6."""

import math

from seafoam.effects.contribution import Bound, Contribution, Effect, SlotFile, number, vector
from seafoam.effects.light import sky_irradiance, sun_irradiance
from seafoam.quality import Quality
from seafoam.scene.models import Chop, ParametricWave, Scene, Water


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by ``water.depth`` under a light."""
    water, light = scene.water, scene.light
    if water.depth is None or light is None:
        return None
    # The shortest way down and back is straight, under a trough. Floor and deep water differ by less than the floor at
    # reflectance 1.
    most = 0.0
    for sun, sky, length in zip(sun_irradiance(light), sky_irradiance(light), water.absorption_length, strict=True):
        passed = math.exp(-2.0 * water.depth * (1.0 / length + water.scattering))
        most = max(most, passed * 0.95 * (sun + sky) / math.pi * 2.0**light.exposure)
    return Contribution(
        why=f"a floor {water.depth:g} m under the troughs",
        slots=(SlotFile("body", "body/floor.glsl"),),
        uniforms={
            "u_floor_albedo": vector(water.floor_albedo, "/water/floor_albedo"),
            "u_floor_depth": number(water.depth),
        },
        bound=Bound(
            most,
            f"no light comes back from {water.depth:g} m",
            ("/light/exposure", "/water/absorption_length", "/water/scattering"),
        ),
    )


EFFECT = Effect(
    "floor",
    contribute,
    invisible=(
        Scene(water=Water(depth=11000.0)),
        Scene(waves=(ParametricWave(),), water=Water(depth=500.0, chop=Chop())),
    ),
)
