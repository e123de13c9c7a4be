"""Clouds: a layer of gradient noise over a round earth. docs/formulae.md, section 9."""

import math

from seafoam.effects.effect import Bound, Contribution, Effect, HardCase, Knob, SlotFile
from seafoam.effects.light import atmosphere
from seafoam.effects.light.noise import PERLIN_3
from seafoam.framegraph.rules import Phase, array, number, significant, vector
from seafoam.quality import Quality
from seafoam.scene.models import Camera, Light, Scene
from seafoam.scene.sky import Clouds, Sky

CELLS = 256
"""The noise repeats after so many cells."""


def _rounded(values: tuple[float, ...]) -> tuple[float, ...]:
    return tuple(significant(value) for value in values)


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by ``light.sky.clouds``."""
    light = scene.light
    if light is None or light.sky is None or light.sky.clouds is None:
        return None
    clouds = light.sky.clouds
    turn = 2.0 * math.pi / (CELLS * clouds.size)
    drift = (clouds.wind * math.cos(clouds.wind_direction), clouds.wind * math.sin(clouds.wind_direction))
    lamp = atmosphere.moon(light) if atmosphere.moon_is_lamp(light) else atmosphere.sun(light)
    assert lamp is not None
    return Contribution(
        why=f"clouds over {100 * clouds.cover:.0f} % of the sky",
        slots=(
            SlotFile(
                "clouds",
                "clouds/layer.glsl",
                needs=PERLIN_3,
            ),
        ),
        consts={"CLOUD_OCTAVES": quality.cloud_octaves, "CLOUD_SEED": 64 * clouds.seed},
        uniforms={
            "u_cloud_phase": array(
                "float",
                [
                    Phase(offset=0.0, rate=-turn * drift[0], k=(turn, 0.0)),
                    Phase(offset=0.0, rate=-turn * drift[1], k=(0.0, turn)),
                    Phase(offset=0.0, rate=2.0 * math.pi / (CELLS * clouds.change), k=(0.0, 0.0)),
                ],
                3,
            ),
            "u_cloud_shape": vector(
                _rounded((clouds.height, clouds.size, atmosphere.cloud_start(clouds), clouds.thickness))
            ),
            "u_cloud_softness": number(clouds.softness),
            "u_cloud_mean": number(significant(atmosphere.cloud_mean(clouds))),
            "u_cloud_toward": vector(_rounded(lamp)),
            "u_cloud_light": vector(_rounded(atmosphere.cloud_light(light))),
            "u_cloud_sky": vector(_rounded(atmosphere.cloud_sky(light))),
        },
        bound=_bound(clouds),
    )


def _bound(clouds: Clouds) -> Bound | None:
    if clouds.cover == 0.0:
        return Bound(0.0, "no share of the sky is covered")
    return Bound(0.0, "clouds without thickness") if clouds.thickness == 0.0 else None


_THIN = Sky(clouds=Clouds(thickness=0.0))

EFFECT = Effect(
    "clouds",
    contribute,
    invisible=(Scene(light=Light(sky=_THIN)), Scene(light=Light(sky=Sky(clouds=Clouds(cover=0.0))))),
    knobs=(Knob("/cloud_octaves", "octaves of the clouds' noise", (2, 3, 4, 5, 6), "geometry"),),
    hard_cases=(
        HardCase(
            name="clouds anywhere, at any time",
            scene=Scene(light=Light(exposure=-2.0, sky=Sky(clouds=Clouds()))),
            guard="the eye's place in the noise reduced in float64 (framegraph/evaluation.py)",
            without="in float32: 45 % of samples off by more than 2 levels at 1e9 s, 1.4 % at 0 s",
            times=(-1e9, 0.0, 1e9),
            camera=Camera(position=(1e7, 3.0, -1e7), pitch=0.3),
        ),
        HardCase(
            name="the layer's way from the horizon to overhead",
            scene=Scene(light=Light(exposure=-2.0, sky=Sky(clouds=Clouds(height=200.0, size=300.0, cover=0.5)))),
            guard="the way to the layer by a quotient, not by a difference of two great numbers (clouds/layer.glsl)",
            without="0.9 % of samples off by more than 2 levels, the worst by 9",
            camera=Camera(position=(0.0, 2.0, 0.0), pitch=0.7, fov=1.5),
        ),
        HardCase(
            name="eye above the clouds",
            scene=Scene(light=Light(exposure=-2.0, sky=Sky(clouds=Clouds()))),
            guard="no clouds from nine tenths of their height up (clouds/layer.glsl)",
            without="the root of a negative number: 21 % of samples off by more than 2 levels",
            camera=Camera(position=(0.0, 9e4, 0.0), pitch=0.1),
        ),
        HardCase(
            name="lamp overhead",
            scene=Scene(light=Light(sun_elevation=math.pi / 2, exposure=-2.5, sky=Sky(clouds=Clouds(cover=0.7)))),
            guard="its level direction divided by at least 1e-6 (clouds/layer.glsl)",
            without="0/0: 42 % of samples off by more than 2 levels",
            camera=Camera(position=(0.0, 3.0, 0.0), pitch=0.5),
        ),
        HardCase(
            name="a hundred thousand little clouds",
            scene=Scene(light=Light(exposure=-2.0, sky=Sky(clouds=Clouds(height=15000.0, size=500.0, cover=0.5)))),
            guard="octaves that are too fine to be told apart give way to their mean (noise/perlin_3.glsl)",
            without="80 % of samples off by more than 2 levels: noise finer than a sample",
            camera=Camera(position=(0.0, 3.0, 0.0), pitch=0.2),
        ),
    ),
)
