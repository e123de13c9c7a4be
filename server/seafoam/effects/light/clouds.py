"""Clouds: a layer of gradient noise over a round earth. docs/formulae.md, section 9."""

from seafoam.effects.effect import Bound, Contribution, Effect, Knob, SlotFile
from seafoam.effects.light import atmosphere
from seafoam.effects.noise import PERLIN_3, drifting_noise
from seafoam.framegraph.rules import number, rounded, significant, vector
from seafoam.quality import Quality
from seafoam.scene.models import Scene
from seafoam.scene.sky import Clouds


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Active if the sky has clouds."""
    light = scene.light
    if light is None or light.sky is None or light.sky.clouds is None:
        return None
    clouds = light.sky.clouds
    lamp = atmosphere.moon(light) if atmosphere.moon_is_lamp(light) else atmosphere.sun(light)
    assert lamp is not None
    return Contribution(
        why=f"clouds over {100 * clouds.cover:.0f} % of the sky",
        slots=(
            SlotFile(
                "clouds",
                "light/clouds/layer.glsl",
                needs=PERLIN_3,
            ),
        ),
        consts={"CLOUD_OCTAVES": quality.cloud_octaves, "CLOUD_SEED": 64 * clouds.seed},
        uniforms={
            "u_cloud_phase": drifting_noise(clouds.size, clouds.wind, clouds.wind_direction, clouds.change),
            "u_cloud_shape": vector(
                rounded((clouds.height, clouds.size, atmosphere.cloud_start(clouds), clouds.thickness))
            ),
            "u_cloud_softness": number(clouds.softness),
            "u_cloud_mean": number(significant(atmosphere.cloud_mean(clouds))),
            "u_cloud_toward": vector(rounded(lamp)),
            "u_cloud_light": vector(rounded(atmosphere.cloud_light(light))),
            "u_cloud_sky": vector(rounded(atmosphere.cloud_sky(light))),
        },
        bound=_bound(clouds),
    )


def _bound(clouds: Clouds) -> Bound | None:
    if clouds.cover == 0.0:
        return Bound(0.0, "clouds cover no part of the sky")
    return Bound(0.0, "clouds have no thickness") if clouds.thickness == 0.0 else None


EFFECT = Effect(
    "clouds",
    contribute,
    fields=("/light/sky/clouds",),
    knobs=(Knob("/cloud_octaves", "octaves of the cloud noise", (2, 3, 4, 5, 6), "geometry"),),
)
