"""How saturation becomes a foam amount: the paper's looks, the filtered threshold, and foam with a history.

docs/formulae.md, section 5.
"""

import math
from dataclasses import dataclass

from seafoam.effects import shader
from seafoam.effects.bounds import no_foam
from seafoam.effects.effect import Contribution, PlanError, QualityParameter, Resources, TextureUse, part_effect
from seafoam.effects.foam import drift
from seafoam.effects.foam.mask_atlas import atlas_of
from seafoam.effects.foam.sources import surf_limit
from seafoam.effects.shader import HASH, PERLIN_2, Piece, SlotFile, Source, constant_function, drifting_phases
from seafoam.framegraph.rules import Uniform, Wrap, array, number, vector
from seafoam.masks.catalogue import Mask, drawn_mask
from seafoam.masks.prefilter import OCTAVE_RAMP
from seafoam.ocean.waves.stokes import foam_drift, foam_life
from seafoam.quality import Quality
from seafoam.scene import Foam, FoamLife, Scene, SurfSaturation
from seafoam.textures.foam import FoamTexture, foam_texture
from seafoam.textures.masks import MaskTable, MaskTexture

AGE = 0.8
"""Age between one mask and the next, in e-folds of the saturation."""
WINDROW_LENGTH = 8.0
"""Length of windrows over their spacing."""
WINDROW_RIDGE = 7.781
"""Factor c for which max(1 - c|n|, -1) has the mean 0 over gradient noise n in the plane (2·10⁶ samples)."""
WINDROW_SEED = 1938
_NO_WINDROWS = constant_function("float", "windrow", "vec2 p, Footprint fp")
_AT_REST = constant_function("vec2", "carry", "vec2 p")
"""No displacement by waves, near a coast as elsewhere."""
CELLS = 4096
"""Number of cells along each side of their lattice after which their rotations repeat."""
_MASKS: dict[str, tuple[MaskTable, str]] = {
    "u8": ("ranks-8", "foam/mask.glsl@texel_u8"),
    "half": ("thresholds-half", "foam/mask.glsl@texel_half"),
    "u16": ("ranks", "foam/mask.glsl@texel_u16"),
}
_LOOKS = {
    "halftone": "foam/look.glsl@halftone",
    "halftone_textured": "foam/look.glsl@halftone_textured",
    "textured": "foam/look.glsl@textured",
    "fading": "foam/look.glsl@fading",
    "listing": "foam/look.glsl@listing",
    "filtered": "foam/look.glsl@filtered",
}
_NO_TEXTURE = constant_function("float", "foam_texture", "vec2 p, Footprint fp", "1.0")


def _living(scene: Scene, foam: Foam, life: FoamLife, quality: Quality) -> Contribution | None:
    """Of the filtered look alone."""
    if foam_life(scene) is None:
        return None
    slots = [SlotFile("carry", "foam/carry.glsl@still", prefix="still")]
    if scene.shore is not None:
        surf = foam.source(SurfSaturation)
        breaks = surf is not None and surf_limit(surf, scene) > 0.0
        unbroken = "foam/carry.glsl@shore" if scene.shore.surf.height > 0.0 else "foam/carry.glsl@shared"
        carry = "foam/carry.glsl@surf" if breaks else unbroken
        slots.append(SlotFile("shore carry", carry if life.carried else _AT_REST))
    drift = foam_drift(scene)
    c, s = math.cos(life.downwind), math.sin(life.downwind)
    across = 1.0 / life.windrow_spacing
    rows = ((c * across / WINDROW_LENGTH, s * across / WINDROW_LENGTH), (-s * across, c * across))
    return Contribution(
        why=f"foam drifts at {math.hypot(*drift):.2g} m/s"
        + (", moved by the waves' orbits" if life.carried else "")
        + (f", {len(life.masks)} masks for older foam" if life.masks else "")
        + (f", in windrows {life.windrow_spacing:g} m apart" if life.row_strength > 0.0 else ""),
        slots=tuple(slots),
        consts={"WINDROW_RIDGE": WINDROW_RIDGE, "WINDROW_SEED": WINDROW_SEED},
        uniforms={
            "u_windrow_phase": drifting_phases(rows, drift, 2.0 * math.pi / shader.NOISE_CELLS),
            "u_windrow_matrix": vector((*rows[0], *rows[1])),
            "u_windrows": number(life.row_strength, "/foam/life/windrows"),
        },
    )


def _draw(scene: Scene, foam: Foam, quality: Quality) -> Contribution:
    masks = _masks(foam)
    parts: list[_Part] = []
    if masks:
        parts.append(_mask_place(scene, foam, masks[0][1]))
    if masks and foam.look != "filtered":
        table, texel = _MASKS[quality.mask]
        ranks = TextureUse(MaskTexture(masks=(foam.mask,), table=table))
        parts.append(_Part(needs=(texel, "foam/mask.glsl@exact"), textures={"mask_ranks": ranks}))
    if _textured(foam):
        parts.append(_texture(foam, quality))
    elif foam.look == "filtered":
        parts.append(_Part(needs=(_NO_TEXTURE,)))
    if foam.look == "filtered":
        parts.append(_filtered_mask(scene, foam, masks, quality))
    look, needs = _look_file(scene, foam, quality)
    contribution = Contribution(
        why=_why(scene, foam, quality),
        slots=(
            SlotFile("look", look, needs=(*(file for part in parts for file in part.needs), *needs)),
            SlotFile("over", "foam/shading.glsl@added" if foam.look == "listing" else "foam/shading.glsl@over"),
            SlotFile("albedo", "foam/shading.glsl@albedo"),
        ),
        uniforms={"u_foam_albedo": number(foam.albedo, "/foam/albedo")},
        bound=no_foam(foam, scene),
    )
    return contribution.joined(*parts)


@dataclass(frozen=True, kw_only=True)
class _Part(Resources):
    """A part of a look. ``needs``: files before the look's own."""

    needs: tuple[Piece, ...] = ()


def _mask(name: str, pointer: str) -> tuple[str, Mask]:
    try:
        return name, drawn_mask(name)
    except KeyError:
        raise PlanError(pointer, f"mask {name!r} was not found; GET /api/masks lists the masks") from None
    except ValueError as error:
        raise PlanError(pointer, str(error)) from None


def _masks(foam: Foam) -> list[tuple[str, Mask]]:
    """The foam's masks, then those of older foam that have the size of the first; none in the textured look."""
    if foam.look == "textured":
        return []
    first = _mask(foam.mask, "/foam/mask")
    if foam.life is None or foam.look != "filtered":
        return [first]
    older = [_mask(name, f"/foam/life/masks/{i}") for i, name in enumerate(foam.life.masks)]
    return [first, *(named for named in older if named[1].ranks.shape == first[1].ranks.shape)]


def _cells(scene: Scene, foam: Foam) -> bool:
    return foam.look != "textured" and foam.cells and foam_life(scene) is None


def _mask_place(scene: Scene, foam: Foam, mask: Mask) -> _Part:
    """Coordinates on the mask: of water that drifts, of cells, or fixed in the world."""
    # Of the mask's rotation, over the side of its tile (1/m).
    c, s = math.cos(foam.mask_angle) / foam.mask_tile, math.sin(foam.mask_angle) / foam.mask_tile
    # From tiles to steps along two sides of the triangles of the cells' lattice.
    first = (c + s / math.sqrt(3.0), s - c / math.sqrt(3.0))
    second = (-2.0 / math.sqrt(3.0) * s, 2.0 / math.sqrt(3.0) * c)
    needs: tuple[Piece, ...] = ("foam/mask.glsl@coordinates",)
    if foam_life(scene) is not None:
        needs = ("foam/mask.glsl@carried",)
    elif foam.cells:
        needs = (HASH, "foam/cells.glsl@cell")
    return _Part(
        needs=needs,
        consts={"MASK_SIZE": mask.ranks.shape[0]},
        uniforms={
            "u_mask_matrix": vector((c, s, -s, c)),
            "u_mask_phase": drifting_phases(((c, s), (-s, c)), foam_drift(scene), 2.0 * math.pi),
            "u_mask_offset": array("vec2", [Wrap(k=(c, s)), Wrap(k=(-s, c))], 1),
            "u_cell_matrix": vector((*first, *second)),
            "u_cell_offset": array("vec2", [Wrap(k=first), Wrap(k=second)], 1),
            "u_cell_index": array("vec2", [Wrap(k=first, period=CELLS), Wrap(k=second, period=CELLS)], 1),
        },
    )


def _filtered_mask(scene: Scene, foam: Foam, masks: list[tuple[str, Mask]], quality: Quality) -> _Part:
    octaves = min(foam.octaves, quality.foam_octaves)
    tables: MaskTable = "ramps" if octaves > 1 else "quantiles"
    mask = masks[0][1]
    levels = mask.ranks.shape[0].bit_length()
    return _Part(
        consts={
            "QUANTILES": len(mask.quantile),
            "FOAM_FADES": foam.fade > 0.0,
            "FOAM_LIVES": foam_life(scene) is not None,
            "FOAM_MASKS": len(masks),
            "FOAM_AGE": AGE,
            "FOAM_OCTAVES": octaves,
            "OCTAVE_RAMP": OCTAVE_RAMP,
            "FOAM_TEXTURED": _textured(foam),
            "FOAM_SIDE": math.isqrt(quality.foam_taps),
            "MASK_LEVELS": levels,
            "MASK_ROWS": levels + (2 if octaves > 1 else 1),
        },
        uniforms={"u_foam_fade": number(foam.fade), "u_foam_texture_share": number(foam.texture)},
        needs=("lib/texels.glsl@cubic_spline",),
    ).joined(atlas_of(masks, tables))


def _textured(foam: Foam) -> bool:
    return foam.look in ("textured", "halftone_textured", "listing") or (foam.look == "filtered" and foam.texture > 0)


def _texture(foam: Foam, quality: Quality) -> _Part:
    file, uniforms = "foam/mask.glsl@texture", _texture_place("", foam.texture_tile)
    if foam.texture_second is not None:
        file, uniforms = "foam/mask.glsl@texture_pair", uniforms | _texture_place("_second", foam.texture_second)
    files: tuple[Piece, ...] = (file,)
    use = TextureUse(FoamTexture(), filter="linear_mipmap_linear")
    if quality.foam_texture == "texels":
        files = ("foam/mask.glsl@texels", Source(file, (("textureLod", "trilinear"),)))
        use = TextureUse(FoamTexture(format="R32F"))
    return _Part(
        needs=files,
        consts={"FOAM_TEXTURE_SIZE": foam_texture().shape[0]},
        uniforms=uniforms,
        textures={"foam_texture": use},
    )


def _texture_place(name: str, tile: float) -> dict[str, Uniform]:
    scale = 1.0 / tile
    place = array("vec2", [Wrap(k=(scale, 0.0)), Wrap(k=(0.0, scale))], 1)
    return {f"u_foam{name}_tile": number(scale), f"u_foam{name}_offset": place}


def _look_file(scene: Scene, foam: Foam, quality: Quality) -> tuple[str, tuple[Piece, ...]]:
    """The look's file, wrapped by those that rotate, advect or age its mask; and what they need."""
    look, life = _LOOKS[foam.look], foam_life(scene)
    needs: tuple[Piece, ...] = ()
    if _cells(scene, foam):
        blended = foam.look == "filtered"
        needs += (*(("foam/shading.glsl@cover",) if blended else ()), Source(look, (("foam_amount", "cell_amount"),)))
        look = "foam/cells.glsl@blended" if blended else "foam/cells.glsl@sharp"
    if drift.advects_mask(scene, quality):
        look, own = drift.advected_look(look, quality)
        needs += own
    if life is not None:
        needs += (*PERLIN_2, "foam/living.glsl@windrows") if life.row_strength > 0.0 else (_NO_WINDROWS,)
        needs += ("foam/shading.glsl@cover", Source(look, (("foam_amount", "young_amount"),)))
        look = "foam/living.glsl@living"
    return look, needs


def _why(scene: Scene, foam: Foam, quality: Quality) -> str:
    return (
        f"look {foam.look}"
        + (f", mask {foam.mask}" if foam.look != "textured" else "")
        + (", rotated in each cell" if _cells(scene, foam) else "")
        + (", advected by the drift" if drift.advects_mask(scene, quality) else "")
        + (", drifting and ageing" if foam_life(scene) is not None else "")
    )


LIVING = part_effect("foam that lives", _living, "/foam/life", afloat=("u_windrow_phase",))
EFFECT = part_effect(
    "foam look",
    _draw,
    "/foam",
    QualityParameter("/mask", "format of the mask's thresholds", ("u8", "half", "u16"), "precision"),
    QualityParameter("/foam_taps", "mask texels averaged under minification", (4, 16), "filtering"),
    QualityParameter("/foam_texture", "filter of the foam texture", ("sampler", "texels"), "precision"),
    QualityParameter("/foam_octaves", "maximum octaves of the mask", (1, 2, 3, 4), "filtering"),
    afloat=("u_mask_offset", "u_mask_phase", "u_cell_offset", "u_cell_index", "u_foam_offset", "u_foam_second_offset"),
)
