"""The atlas that the filtered look reads, made of the mask by passes that are drawn once. docs/masks.md.

A mask travels as 16 bits a texel; its atlas, :func:`seafoam.masks.prefilter.atlas`, takes ten times as much and is the
same to the last bit.
"""

from seafoam.effects.contribution import FixedSize, PassSpec, Target, TargetInput, TextureInput, number
from seafoam.masks.catalogue import Mask

ATLAS = "mask_atlas"
MOMENTS = "mask_moments"


def consts(mask: Mask) -> dict[str, int]:
    """``MASK_STEP``: thresholds stand half of so many 65536ths over what the texels hold."""
    return {"MASK_STEP": max(65536 // mask.ranks.size, 1)}


def targets(mask: Mask) -> dict[str, Target]:
    """The atlas, and what it is made by way of."""

    def whole(width: int, height: int) -> Target:
        return Target(size=FixedSize(width=width, height=height), format="RG32UI")

    size = mask.ranks.shape[0]
    return {
        ATLAS: whole(5 * size // 2, size),
        MOMENTS: whole(size, size),
        **{_levels(i): whole(size // 2, size) for i in range(2)},
    }


def passes(mask: Mask) -> tuple[PassSpec, ...]:
    """Mean and variance of the thresholds in a texel, then level by level, then the atlas.

    They read the textures ``mask_ranks`` and ``mask_quantiles``.
    """
    size = mask.ranks.shape[0]
    ranks = {"u_mask_ranks": TextureInput(texture="mask_ranks")}
    made = [
        PassSpec(
            name="mask: moments",
            program="mask_moments",
            fragment=("mask/moments_pass.glsl",),
            target=MOMENTS,
            inputs={**ranks, "u_mask_quantiles": TextureInput(texture="mask_quantiles")},
        )
    ]
    source, side, row, level = MOMENTS, size // 2, 0, 0
    while side >= 1:
        level += 1
        made.append(
            PassSpec(
                name=f"mask: moments, level {level}",
                program="mask_halve",
                fragment=("mask/halve_pass.glsl",),
                target=_levels(level % 2),
                inputs={"u_mask_moments": TargetInput(target=source)},
                uniforms={"u_mask_side": number(float(side)), "u_mask_finer_row": number(float(row))},
            )
        )
        source, row, side = _levels(level % 2), size - 2 * side, side // 2
    made.append(
        PassSpec(
            name="mask: atlas",
            program="mask_atlas",
            fragment=("mask/atlas_pass.glsl",),
            target=ATLAS,
            inputs={
                **ranks,
                "u_mask_moments": TargetInput(target=MOMENTS),
                "u_mask_levels": TargetInput(target=source),
            },
        )
    )
    return tuple(made)


def _levels(number: int) -> str:
    return f"mask_levels_{number}"
