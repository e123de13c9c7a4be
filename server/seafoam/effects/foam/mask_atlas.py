"""The atlas that the filtered look reads, drawn once from its masks. docs/masks.md.

A mask is transferred as 16 bits per texel; its atlas, :func:`seafoam.masks.prefilter.atlas`, is ten times as large and
bit-identical on all executors. Foam with a history has several masks: their atlases and tables are stacked.
"""

from collections.abc import Sequence

from seafoam.effects.effect import PassSpec, Resources, TextureUse
from seafoam.framegraph.resources import FixedSize, Target
from seafoam.framegraph.rules import number
from seafoam.masks.catalogue import Mask
from seafoam.textures.masks import MaskTable, MaskTexture

ATLAS = "mask_atlas"
MOMENTS = "mask_moments"


def atlas_of(named: Sequence[tuple[str, Mask]], kind: MaskTable) -> Resources:
    """The atlas of masks with their names, and the tables that the look reads: ``kind`` of all masks, stacked.

    ``MASK_STEP``: thresholds are the texels' values plus half this number of 65536ths.
    """
    names, masks = zip(*named, strict=True)
    tables = f"mask_{kind}" if len(masks) == 1 else "mask_tables"
    used: dict[str, TextureUse] = {}
    for i, name in enumerate(names):
        used[f"mask_ranks{_suffix(i)}"] = TextureUse(MaskTexture(masks=(name,), table="ranks"))
        # The atlas is made with the quantiles whatever the look itself reads.
        used[f"mask_quantiles{_suffix(i)}"] = _table((name,), "quantiles")
    return Resources(
        consts={"MASK_STEP": max(65536 // masks[0].ranks.size, 1)},
        inputs={"u_mask_quantiles": tables},
        textures={**used, tables: _table(names, kind)},
        targets=_targets(masks),
        passes=_all_passes(masks),
    )


def _table(names: tuple[str, ...], kind: MaskTable) -> TextureUse:
    return TextureUse(MaskTexture(masks=names, table=kind), wrap="clamp_to_edge")


def _targets(masks: Sequence[Mask]) -> dict[str, Target]:
    def whole(width: int, height: int) -> Target:
        return Target(size=FixedSize(width=width, height=height), format="RG32UI")

    size = masks[0].ranks.shape[0]
    intermediate: dict[str, Target] = {}
    for index in range(len(masks)):
        intermediate[MOMENTS + _suffix(index)] = whole(size, size)
        intermediate |= {_levels(i) + _suffix(index): whole(size // 2, size) for i in range(2)}
    if len(masks) > 1:
        intermediate |= {f"{ATLAS}{_suffix(i)}_alone": whole(5 * size // 2, size) for i in range(len(masks))}
    return {ATLAS: whole(5 * size // 2, size * len(masks)), **intermediate}


def _all_passes(masks: Sequence[Mask]) -> tuple[PassSpec, ...]:
    """For each mask: mean and variance of the thresholds per texel, then per level, then the atlas."""
    if len(masks) == 1:
        return _passes(masks[0], 0, ATLAS)
    alone = [f"{ATLAS}{_suffix(i)}_alone" for i in range(len(masks))]
    # The shader reads three atlases; the last one is repeated where there are fewer.
    which = [min(i, len(masks) - 1) for i in range(3)]
    return (
        *(spec for i, mask in enumerate(masks) for spec in _passes(mask, i, alone[i])),
        PassSpec(
            "mask: atlases of all ages",
            "mask_stack",
            ("foam/mask_passes.glsl@stack",),
            {f"u_mask_atlas_{i}": alone[index] for i, index in enumerate(which)},
            target=ATLAS,
        ),
    )


def _passes(mask: Mask, index: int, atlas: str) -> tuple[PassSpec, ...]:
    size, moments = mask.ranks.shape[0], MOMENTS + _suffix(index)
    ranks = {"u_mask_ranks": f"mask_ranks{_suffix(index)}"}
    files, read = ("foam/mask_passes.glsl@moments",), {**ranks, "u_mask_quantiles": f"mask_quantiles{_suffix(index)}"}
    specs = [PassSpec("mask: moments", "mask_moments", files, read, target=moments)]
    source, side, row, level = moments, size // 2, 0, 0
    while side >= 1:
        level += 1
        target = _levels(level % 2) + _suffix(index)
        sizes = {"u_mask_side": number(float(side)), "u_mask_finer_row": number(float(row))}
        name, files = f"mask: moments, level {level}", ("foam/mask_passes.glsl@halve",)
        specs.append(PassSpec(name, "mask_halve", files, {"u_mask_moments": source}, sizes, target))
        source, row, side = target, size - 2 * side, side // 2
    files, read = ("foam/mask_passes.glsl@atlas",), {**ranks, "u_mask_moments": moments, "u_mask_levels": source}
    last = PassSpec("mask: atlas", "mask_atlas", files, read, target=atlas)
    return (*specs, last)


def _suffix(index: int) -> str:
    return f"_{index}" if index else ""


def _levels(number: int) -> str:
    return f"mask_levels_{number}"
