"""Glare around bright light, as in eye and lens. docs/formulae.md, section 7.

It is part of the display, as the tone curve is: linear frames are without it.
"""

import itertools

from seafoam.effects.effect import FINISHED, Contribution, Effect, PassSpec
from seafoam.effects.shader import SlotFile
from seafoam.framegraph.resources import Target, TargetInput, ViewportSize
from seafoam.framegraph.rules import number
from seafoam.quality import Quality
from seafoam.scene.models import Scene

LEVELS = 6
"""Number of levels; the first has a texel for 4 × 4 pixels, and each has half the rows of the one before."""

_TAPS = "output/glare.glsl@taps"


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Active if the light has a glare."""
    light = scene.light
    if light is None or light.glare == 0.0:
        return None
    sizes = [4 << k for k in range(LEVELS)]
    names = [f"glare {size}" for size in sizes]
    narrowing = [
        PassSpec(
            name=f"{coarser}: mean of {finer}",
            program="glare, half",
            fragment=(_TAPS, "output/glare.glsl@half"),
            target=coarser,
            inputs={"u_finer": TargetInput(target=finer)},
            stage="finished",
        )
        for finer, coarser in itertools.pairwise(names)
    ]
    adding = [
        PassSpec(
            name=f"{finer}: with {coarser}",
            program="glare, add",
            fragment=(_TAPS, "output/glare.glsl@add"),
            target=finer,
            inputs={"u_coarser": TargetInput(target=coarser)},
            stage="finished",
            blend="add",
        )
        for finer, coarser in reversed([*itertools.pairwise(names)])
    ]
    first = PassSpec(
        name=f"{names[0]}: of the frame",
        program="glare, first",
        fragment=("output/glare.glsl@first",),
        target=names[0],
        inputs={"u_frame": TargetInput(target=FINISHED)},
        stage="finished",
    )
    return Contribution(
        why=f"{100 * light.glare:.0f} % of the light spreads",
        slots=(SlotFile("glare", "output/glare.glsl@spread", needs=(_TAPS,)),),
        consts={"GLARE_LEVELS": LEVELS},
        uniforms={"u_glare_share": number(light.glare)},
        inputs={"u_glare": TargetInput(target=names[0])},
        targets={
            name: Target(size=ViewportSize(part=size), format="RGBA16F", filter="linear")
            for name, size in zip(names, sizes, strict=True)
        },
        passes=(first, *narrowing, *adding),
    )


EFFECT = Effect("glare", contribute, fields=("/light/glare",))
