"""The glitter of sun or moon on the water, and the sun's disc in the sky. docs/formulae.md, section 6."""

import math

from seafoam.effects.effect import Bound, Contribution, part_effect
from seafoam.effects.light import atmosphere
from seafoam.effects.light.light import brightest_sun, sun_disc
from seafoam.effects.shader import SlotFile
from seafoam.framegraph.rules import Uniform, number, rounded, vector
from seafoam.quality import Quality
from seafoam.scene.light import Light
from seafoam.scene.models import Scene


def smooth_glint(light: Light) -> tuple[str, tuple[str, ...], dict[str, Uniform]]:
    """Return the file of the light's highlight model, the files that it calls, and its uniforms."""
    if light.specular == "glint":
        return "light/glitter.glsl@beckmann", ("lib/refraction.glsl", "light/shade.glsl@irradiance"), {}
    uniforms = {
        "u_specular_power": number(light.specular_power, "/light/specular_power"),
        "u_specular_perturb": number(light.specular_perturb, "/light/specular_perturb"),
    }
    return "light/glitter.glsl@blinn_phong", ("light/shade.glsl@irradiance",), uniforms


def brightest_glint(scene: Scene) -> float:
    """Return the greatest radiance of the sun, reflected or in the sky, display white = 1; 0 without a light."""
    if scene.light is None:
        return 0.0
    # The peak of the specular lobe for a level surface at grazing angle, where cv equals the roughness; the factor 4
    # covers surfaces whose roughness includes unresolved waves.
    sigma = scene.water.roughness
    brightest: float = max(brightest_sun(scene.light)) * math.exp2(scene.light.exposure)
    return brightest * max(1.0 / (math.pi * sigma**3), 1.0 / 6.8e-5)


def _draw(scene: Scene, light: Light, quality: Quality) -> Contribution:
    path, needs, uniforms = smooth_glint(light)
    return Contribution(
        why="glitter of the moon" if atmosphere.moon_is_lamp(light) else "glitter of the sun",
        slots=(SlotFile("glitter", path, needs=needs), SlotFile("disc", "light/sky.glsl@sun_disc")),
        uniforms={"u_sun_disc": vector(rounded(sun_disc(light))), **uniforms},
        bound=Bound(brightest_glint(scene), "the lamp is below the horizon", ("/light/exposure", "/water/roughness")),
    )


EFFECT = part_effect(
    "sun glitter", _draw, "/light", fields=("/light/specular", "/light/specular_power", "/light/specular_perturb")
)
