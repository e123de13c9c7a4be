"""The glitter of sun or moon on the water, and the sun's disc in the sky; sparkles in its place (GPU ocean, 2007); and
glare around bright light, as in eye and lens. docs/formulae.md, sections 6, 7 and 12.
"""

import itertools
import math
from dataclasses import replace

from seafoam.effects.effect import Bound, Contribution, PassSpec, QualityParameter, part_effect
from seafoam.effects.light import atmosphere
from seafoam.effects.light.light import sun_disc, sun_irradiance
from seafoam.effects.shader import HASH, SlotFile, SlotRef, Source
from seafoam.framegraph.resources import Target, ViewportSize
from seafoam.framegraph.rules import Loop, Uniform, Viewport, array, number, rounded, significant, vector
from seafoam.quality import Quality
from seafoam.scene import Light, Scene, Sparkles

EPOCHS = 65536
"""Period of the sparkles, in lifetimes: five hours at the default."""
GLARE_LEVELS = 6
"""Levels of glare; the first has a texel for 4 × 4 pixels, and each has half the rows of the one before."""
_TAPS = "output/glare.glsl@taps"
_SQUARE_DEGREES = (180.0 / math.pi) ** 2


def smooth_glint(light: Light) -> tuple[str, tuple[str, ...], dict[str, Uniform]]:
    """Return the file of the light's highlight model, the files that it calls, and its uniforms."""
    if light.specular == "glint":
        return "light/glitter.glsl@beckmann", ("lib/refraction.glsl", "light/shade.glsl@irradiance"), {}
    uniforms = {
        "u_specular_power": number(light.specular_power, "/light/specular_power"),
        "u_specular_perturb": number(light.specular_perturb, "/light/specular_perturb"),
    }
    return "light/glitter.glsl@blinn_phong", ("light/shade.glsl@irradiance",), uniforms


def _no_lamp(light: Light) -> Bound | None:
    fields = ("/light/exposure", "/water/roughness")
    return Bound.zero_if(not sun_irradiance(light).any(), "the lamp is below the horizon", fields)


def _draw(scene: Scene, light: Light, quality: Quality) -> Contribution:
    path, needs, uniforms = smooth_glint(light)
    return Contribution(
        why="glitter of the moon" if atmosphere.moon_is_lamp(light) else "glitter of the sun",
        slots=(SlotFile("glitter", path, needs=needs), SlotFile("disc", "light/sky.glsl@sun_disc")),
        uniforms={"u_sun_disc": vector(rounded(sun_disc(light))), **uniforms},
        bound=_no_lamp(light),
    )


def density(sparkles: Sparkles) -> float:
    """Return simultaneous sparkles per steradian where the glint's radiance is the sun's irradiance / sr."""
    return math.pi * sparkles.rate * _SQUARE_DEGREES * sparkles.life


def _sparkles(scene: Scene, light: Light, sparkles: Sparkles, quality: Quality) -> Contribution:
    radius = 0.5 * sparkles.size
    path, needs, uniforms = smooth_glint(light)
    smooth = Source(path, (("glitter_light", "smooth_glitter"),))
    return Contribution(
        why=f"sparkles of {1e3 * sparkles.size:g} mrad that last {sparkles.life:g} s",
        slots=(SlotFile("glitter", "light/glitter.glsl@sparkles", needs=(*needs, HASH, smooth), instead=True),),
        consts={"SPARKLE_CELLS": quality.sparkle_cells},
        uniforms={
            **uniforms,
            "u_sparkle_radius": number(significant(radius)),
            "u_sparkle_density": number(significant(density(sparkles))),
            "u_sparkle_share": number(sparkles.share, "/light/sparkles/share"),
            "u_sparkle_life": number(sparkles.life),
            "u_sparkle_time": array("float", [Loop(period=sparkles.life), Loop(period=sparkles.life * EPOCHS)], 2),
        },
        bound=_no_lamp(light),
    )


def _glare(scene: Scene, light: Light, share: float, quality: Quality) -> Contribution:
    """Part of the display, as the tone curve is: linear frames are without it."""
    sizes = [4 << k for k in range(GLARE_LEVELS)]
    names = [f"glare {size}" for size in sizes]
    pairs = list(itertools.pairwise(names))
    first = SlotRef("block mean"), "output/glare.glsl@first"
    half, add = (_TAPS, "output/glare.glsl@half"), (_TAPS, "output/glare.glsl@add")
    picture = {"u_viewport": Uniform(type="vec2", rules=(Viewport(of="picture"),))}
    passes = (
        PassSpec(f"{names[0]}: of the frame", "glare, first", first, uniforms=picture, target=names[0]),
        *(PassSpec(f"{b}: mean of {a}", "glare, half", half, {"u_finer": a}, target=b) for a, b in pairs),
        *(
            PassSpec(f"{a}: with {b}", "glare, add", add, {"u_coarser": b}, target=a, blend="add")
            for a, b in reversed(pairs)
        ),
    )
    return Contribution(
        why=f"{100 * share:.0f} % of the light spreads",
        slots=(SlotFile("glare", "output/glare.glsl@spread"),),
        consts={"GLARE_LEVELS": GLARE_LEVELS},
        uniforms={"u_glare_share": number(share)},
        inputs={"u_glare": names[0]},
        targets={
            name: Target(size=ViewportSize(part=size), format="RGBA16F", filter="linear")
            for name, size in zip(names, sizes, strict=True)
        },
        passes=tuple(replace(one, stage="finished") for one in passes),
    )


GLITTER = part_effect(
    "sun glitter", _draw, "/light", fields=("/light/specular", "/light/specular_power", "/light/specular_perturb")
)
SPARKLES = part_effect(
    "sparkles",
    _sparkles,
    "/light/sparkles",
    QualityParameter("/sparkle_cells", "sparkle cells per sample", (1, 4), "geometry"),
)
GLARE = part_effect("glare", _glare, "/light/glare")
