"""The glitter of sun or moon on the water, and the sun's disc in the sky. docs/formulae.md, section 6."""

import math

from seafoam.effects.effect import Bound, Contribution, Effect, HardCase, SlotFile
from seafoam.effects.light import atmosphere
from seafoam.effects.light.light import sun_disc, sun_irradiance
from seafoam.framegraph.rules import Uniform, number, vector
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


def smooth_glint(light: Light) -> tuple[str, tuple[str, ...], dict[str, Uniform]]:
    """The file of ``light.specular``, those it needs, and its uniforms."""
    if light.specular == "glint":
        return "glitter/beckmann.glsl", ("shade/fresnel.glsl", "shade/sun.glsl"), {}
    uniforms = {
        "u_specular_power": number(light.specular_power, "/light/specular_power"),
        "u_specular_perturb": number(light.specular_perturb, "/light/specular_perturb"),
    }
    return "glitter/blinn_phong.glsl", ("shade/sun.glsl",), uniforms


def brightest_glint(scene: Scene) -> float:
    """Most that the sun adds to a pixel, on the water or in the sky, display white = 1; 0 without a light."""
    if scene.light is None:
        return 0.0
    # The peak of the mirror's lobe: all facets alike, seen at grazing, where cv is the roughness itself; the factor 4
    # covers the lobe of a surface made rough by its filtered waves.
    sigma = scene.water.roughness
    brightest: float = max(sun_irradiance(scene.light)) * math.exp2(scene.light.exposure)
    return brightest * max(1.0 / (math.pi * sigma**3), 1.0 / 6.8e-5)


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by ``light``; where there are sparkles, they bring the glint that they are made of."""
    light = scene.light
    if light is None:
        return None
    path, needs, uniforms = smooth_glint(light)
    own = (SlotFile("glitter", path, needs=needs),) if light.sparkles is None else ()
    return Contribution(
        why="the moon is up" if atmosphere.moon_is_lamp(light) else "the sun is up",
        slots=(*own, SlotFile("disc", "sky/sun_disc.glsl")),
        uniforms={"u_sun_disc": vector(sun_disc(light)), **(uniforms if own else {})},
        bound=Bound(brightest_glint(scene), "the sun is down", ("/light/exposure", "/water/roughness")),
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
        HardCase(
            name="the lake's highlight at its sharpest",
            scene=Scene(
                light=Light(
                    sun_elevation=0.1,
                    sun_azimuth=math.pi,
                    specular="blinn_phong",
                    specular_power=2000.0,
                    specular_perturb=0.0,
                ),
                water=Water(chop=Chop(slope=0.6)),
            ),
            guard="n.h held in [0, 1] before the power (glitter/blinn_phong.glsl)",
            without="powers of negative numbers: 65504 in a fifth of the samples, off by 28 levels in the mean",
            camera=Camera(position=(0.0, 2.0, 0.0), yaw=math.pi / 2, pitch=-0.1),
        ),
    ),
)
