"""The glitter of sun or moon on the water, and the sun's disc in the sky. docs/formulae.md, section 6."""

import math

from seafoam.effects import layered
from seafoam.effects.contribution import (
    Bound,
    Contribution,
    Effect,
    HardCase,
    SlotFile,
    vector,
)
from seafoam.effects.light import sun_disc, sun_irradiance
from seafoam.quality import Quality
from seafoam.scene.models import (
    Camera,
    Chop,
    Light,
    ParametricWave,
    Scene,
    Water,
)

_DOWN = Light(sun_elevation=-0.1)


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by ``light``."""
    light = scene.light
    if light is None:
        return None
    # The peak of the mirror's lobe: all facets alike, seen at grazing, where cv is the roughness itself; the factor 4
    # covers the lobe of a surface made rough by its filtered waves.
    sigma = scene.water.roughness
    brightest = max(sun_irradiance(light)) * 2.0**light.exposure
    return Contribution(
        why="the moon is up" if layered.moon_is_lamp(light) else "the sun is up",
        slots=(
            SlotFile("glitter", "glitter/beckmann.glsl", needs=("shade/fresnel.glsl", "shade/sun.glsl")),
            SlotFile("disc", "sky/sun_disc.glsl"),
        ),
        uniforms={"u_sun_disc": vector(sun_disc(light))},
        bound=Bound(
            brightest * max(1.0 / (math.pi * sigma**3), 1.0 / 6.8e-5),
            "the sun is down",
            ("/light/exposure", "/water/roughness"),
        ),
    )


EFFECT = Effect(
    "sun glitter",
    contribute,
    invisible=(Scene(light=_DOWN), Scene(light=Light(sun_elevation=-math.pi / 2))),
    hard_cases=(
        HardCase(
            name="into the sun on the horizon",
            scene=Scene(light=Light(sun_elevation=0.0, exposure=10.0), water=Water(roughness=0.03)),
            guard="h divided by at least 1e-6 (glitter/beckmann.glsl)",
            without="nothing on llvmpipe, whose max(0/0, x) is x: NaN in h alone",
            camera=Camera(position=(0.0, 1.0, 0.0), yaw=math.pi / 2, pitch=0.0, fov=0.01),
        ),
        HardCase(
            name="facets seen edge-on",
            scene=Scene(
                waves=(ParametricWave(amplitude=2.0, wavelength=3.0, exponent=8.0),),
                light=Light(sun_elevation=0.02, sun_azimuth=math.pi),
                water=Water(roughness=0.03),
            ),
            guard="n.h at least 1e-3 (glitter/beckmann.glsl)",
            without="facets that face away mirror the sun: 10 000, the cap, instead of 0 at n.h = -1",
            camera=Camera(position=(0.0, 3.0, 0.0), yaw=math.pi / 2, pitch=-0.3),
        ),
        HardCase(
            name="the brightest path of the sun",
            scene=Scene(
                light=Light(sun_elevation=0.05, exposure=10.0), water=Water(roughness=0.03, chop=Chop(slope=0.05))
            ),
            guard="glitter held at 1e4 (glitter/beckmann.glsl), the frame at 65504 (surface/main.glsl)",
            without="5.9e6, ninety times what half floats hold",
            camera=Camera(position=(0.0, 2.0, 0.0), yaw=math.pi / 2, pitch=-0.05, fov=0.3),
        ),
    ),
)
