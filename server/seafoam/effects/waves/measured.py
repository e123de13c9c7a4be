"""Bounds of waves that a map holds, measured in each frame: passes that find its greatest height, slope and curvature.

docs/formulae.md, section 3.
"""

from seafoam.effects.effect import Inline, PassSpec
from seafoam.framegraph.resources import FixedSize, Target, TargetInput
from seafoam.framegraph.rules import number

BLOCK = 16
"""Texels along a side of the blocks whose greatest values are found first."""


def measured_bounds(
    source: str, size: int, texel: float, stride: int = 1
) -> tuple[dict[str, Target], tuple[PassSpec, ...]]:
    """Targets and passes; the last one fills ``SOURCE_bounds``: height (m), slope, second derivative (1/m).

    ``source``: a target of ``size``² texels of ``texel`` m: height, slopes along x and z. ``stride``: every so many
    texels are looked at, of waves that have at least four times as many to their length. ``size``: a multiple of
    :data:`BLOCK`.
    """
    blocks, bounds = f"{source}_blocks", f"{source}_bounds"
    targets = {
        blocks: Target(size=FixedSize(width=-(-size // BLOCK), height=-(-size // BLOCK)), format="RGBA16F"),
        bounds: Target(size=FixedSize(width=1, height=1), format="RGBA16F"),
    }
    passes = (
        PassSpec(
            name=f"{source}, greatest of blocks",
            program=f"bounds_{stride}",
            fragment=(
                Inline(f"const int BOUNDS_BLOCK = {BLOCK};\nconst int BOUNDS_STRIDE = {stride};\n"),
                "surface/bounds_pass.glsl",
            ),
            target=blocks,
            inputs={"u_bounded": TargetInput(target=source)},
            uniforms={"u_bounded_texel": number(texel)},
        ),
        PassSpec(
            name=f"{source}, greatest of all",
            program="bounds_join",
            fragment=("surface/bounds_join_pass.glsl",),
            target=bounds,
            inputs={"u_blocks": TargetInput(target=blocks)},
        ),
    )
    return targets, passes
