"""Glare around bright light, as in eye and lens. docs/formulae.md, section 7.

It is part of the display, as the tone curve is: linear frames are without it.
"""

import itertools
from dataclasses import replace

from seafoam.effects.effect import FINISHED, Contribution, PassSpec, part_effect
from seafoam.effects.shader import SlotFile
from seafoam.framegraph.resources import Target, TargetInput, ViewportSize
from seafoam.framegraph.rules import number
from seafoam.quality import Quality
from seafoam.scene.light import Light
from seafoam.scene.models import Scene

LEVELS = 6
"""Number of levels; the first has a texel for 4 × 4 pixels, and each has half the rows of the one before."""
_TAPS = "output/glare.glsl@taps"


def _draw(scene: Scene, light: Light, share: float, quality: Quality) -> Contribution:
    sizes = [4 << k for k in range(LEVELS)]
    names = [f"glare {size}" for size in sizes]
    pairs = list(itertools.pairwise(names))
    first, half, add = ("output/glare.glsl@first",), (_TAPS, "output/glare.glsl@half"), (_TAPS, "output/glare.glsl@add")
    passes = (
        PassSpec(f"{names[0]}: of the frame", "glare, first", first, {"u_frame": FINISHED}, target=names[0]),
        *(PassSpec(f"{b}: mean of {a}", "glare, half", half, {"u_finer": a}, target=b) for a, b in pairs),
        *(
            PassSpec(f"{a}: with {b}", "glare, add", add, {"u_coarser": b}, target=a, blend="add")
            for a, b in reversed(pairs)
        ),
    )
    return Contribution(
        why=f"{100 * share:.0f} % of the light spreads",
        slots=(SlotFile("glare", "output/glare.glsl@spread"),),
        consts={"GLARE_LEVELS": LEVELS},
        uniforms={"u_glare_share": number(share)},
        inputs={"u_glare": TargetInput(target=names[0])},
        targets={
            name: Target(size=ViewportSize(part=size), format="RGBA16F", filter="linear")
            for name, size in zip(names, sizes, strict=True)
        },
        passes=tuple(replace(one, stage="finished") for one in passes),
    )


EFFECT = part_effect("glare", _draw, "/light/glare")
