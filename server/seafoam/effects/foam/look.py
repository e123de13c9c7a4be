"""How saturation becomes foam: the paper's looks and the filtered threshold. docs/formulae.md, section 5."""

import math

from seafoam.effects.bounds import foam_limit, greatest_saturation, saturation_fields
from seafoam.effects.effect import (
    Bound,
    Const,
    Contribution,
    Effect,
    Knob,
    PassSpec,
    Piece,
    PlanError,
    SlotFile,
    Source,
    TextureUse,
    constant_function,
)
from seafoam.effects.foam import drift, mask_atlas
from seafoam.effects.foam.living import AGE, living
from seafoam.effects.light.noise import HASH
from seafoam.framegraph.resources import Target, TargetInput, TextureInput
from seafoam.framegraph.rules import Phase, Uniform, Wrap, array, number, vector
from seafoam.masks.catalogue import Mask, mask_by_name
from seafoam.masks.prefilter import OCTAVE_RAMP
from seafoam.ocean.stokes import foam_drift, foam_life
from seafoam.quality import Quality
from seafoam.scene.foam import Foam
from seafoam.scene.models import Scene
from seafoam.textures import foam_texture

CELLS = 4096
"""Cells along each side of their lattice before their turns come again."""

_MASK_SOURCES = {"u8": "ranks-8", "half": "thresholds-half", "u16": "ranks"}
_TEXTURE_FILE = "foam/texture.glsl"
_TEXTURE_PAIR_FILE = "foam/texture_pair.glsl"


def _mask(name: str, pointer: str) -> Mask:
    try:
        return mask_by_name(name)
    except KeyError:
        raise PlanError(pointer, f"mask {name!r} was not found; GET /api/masks lists the masks") from None
    except ValueError as error:
        raise PlanError(pointer, str(error)) from None


def _masks(foam: Foam) -> list[tuple[str, Mask]]:
    """The foam's masks, those of older foam last; without those that are of another size than the first."""
    first = _mask(foam.mask, "/foam/mask")
    if foam.life is None or foam.look != "filtered":
        return [(foam.mask, first)]
    older = [(name, _mask(name, f"/foam/life/masks/{i}")) for i, name in enumerate(foam.life.masks)]
    return [(foam.mask, first), *((name, mask) for name, mask in older if mask.ranks.shape == first.ranks.shape)]


def _turned(foam: Foam) -> tuple[float, float]:
    """Cosine and sine of the mask's turn, over its tile's side (1/m)."""
    return math.cos(foam.mask_angle) / foam.mask_tile, math.sin(foam.mask_angle) / foam.mask_tile


def _mask_uniforms(foam: Foam) -> dict[str, Uniform]:
    """The eye's place on the mask."""
    c, s = _turned(foam)
    return {"u_mask_offset": array("vec2", [Wrap(k=(c, s)), Wrap(k=(-s, c))], 1)}


def _carried_uniforms(foam: Foam, drift: tuple[float, float]) -> dict[str, Uniform]:
    """The eye's place on a mask that drifts (x, z) m/s."""
    c, s = _turned(foam)
    turn = 2.0 * math.pi
    places = [
        Phase(offset=0.0, rate=-turn * (x * drift[0] + z * drift[1]), k=(turn * x, turn * z))
        for x, z in ((c, s), (-s, c))
    ]
    return {"u_mask_phase": array("float", places, 2)}


def _cell_uniforms(foam: Foam) -> dict[str, Uniform]:
    """The eye's place on the lattice of cells: whole steps apart from the rest."""
    c, s = _turned(foam)
    # Tiles to steps along the two sides of the triangles.
    first = (c + s / math.sqrt(3.0), s - c / math.sqrt(3.0))
    second = (-2.0 / math.sqrt(3.0) * s, 2.0 / math.sqrt(3.0) * c)
    return {
        "u_cell_matrix": vector((*first, *second)),
        "u_cell_offset": array("vec2", [Wrap(k=first), Wrap(k=second)], 1),
        "u_cell_index": array("vec2", [Wrap(k=first, period=CELLS), Wrap(k=second, period=CELLS)], 1),
    }


def _texture_uniforms(foam: Foam) -> dict[str, Uniform]:
    def place(name: str, tile: float) -> dict[str, Uniform]:
        scale = 1.0 / tile
        return {
            f"u_foam{name}_tile": number(scale),
            f"u_foam{name}_offset": array("vec2", [Wrap(k=(scale, 0.0)), Wrap(k=(0.0, scale))], 1),
        }

    if foam.texture_second is None:
        return place("", foam.texture_tile)
    return place("", foam.texture_tile) | place("_second", foam.texture_second)


_NO_TEXTURE = constant_function("float", "foam_texture", "vec2 p, Footprint fp", "1.0")


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by foam."""
    foam = scene.foam
    if foam is None:
        return None
    masked = foam.look != "textured"
    textured = foam.look in ("textured", "halftone_textured", "listing") or (
        foam.look == "filtered" and foam.texture > 0
    )
    needs: tuple[Piece, ...] = ()
    consts: dict[str, Const] = {}
    uniforms: dict[str, Uniform] = {"u_foam_albedo": number(foam.albedo, "/foam/albedo")}
    inputs: dict[str, TextureInput | TargetInput] = {}
    textures: dict[str, TextureUse] = {}
    targets: dict[str, Target] = {}
    passes: tuple[PassSpec, ...] = ()
    named = _masks(foam) if masked else []
    masks = [mask for _, mask in named]
    life = foam_life(scene)
    lives = life is not None
    cells = foam.cells and not lives
    if masked:
        mask = masks[0]
        needs += (
            (HASH, "foam/cell.glsl")
            if cells
            else ("foam/mask_carried.glsl" if lives else "foam/mask_coordinates.glsl",)
        )
        consts["MASK_SIZE"] = mask.ranks.shape[0]
        c, s = _turned(foam)
        uniforms["u_mask_matrix"] = vector((c, s, -s, c))
        if lives:
            uniforms |= _carried_uniforms(foam, foam_drift(scene))
        else:
            uniforms |= _cell_uniforms(foam) if cells else _mask_uniforms(foam)
    if masked and foam.look != "filtered":
        needs += (f"foam/mask_texel_{quality.mask}.glsl", "foam/mask_exact.glsl")
        inputs["u_mask_ranks"] = TextureInput(texture="mask_ranks")
        textures["mask_ranks"] = TextureUse(f"mask/{foam.mask}/{_MASK_SOURCES[quality.mask]}")
    if textured:
        needs += (_TEXTURE_FILE if foam.texture_second is None else _TEXTURE_PAIR_FILE,)
        consts["FOAM_TEXTURE_SIZE"] = foam_texture().shape[0]
        uniforms |= _texture_uniforms(foam)
        inputs["u_foam_texture"] = TextureInput(texture="foam_texture")
        textures["foam_texture"] = TextureUse("foam", filter="linear_mipmap_linear")
    if foam.look == "filtered":
        octaves = min(foam.octaves, quality.foam_octaves)
        tables = "ramps" if octaves > 1 else "quantiles"
        levels = mask.ranks.shape[0].bit_length()
        rows = levels + (2 if octaves > 1 else 1)
        needs += ("lib/cubic_spline.glsl",) if textured else ("lib/cubic_spline.glsl", _NO_TEXTURE)
        consts |= {
            "QUANTILES": len(mask.quantile),
            "FOAM_FADES": foam.fade > 0.0,
            "FOAM_LIVES": lives,
            "FOAM_MASKS": len(masks),
            "FOAM_AGE": AGE,
            "FOAM_OCTAVES": octaves,
            "OCTAVE_RAMP": OCTAVE_RAMP,
            "FOAM_TEXTURED": textured,
            "FOAM_SIDE": math.isqrt(quality.foam_taps),
            "MASK_LEVELS": levels,
            "MASK_ROWS": rows,
        }
        uniforms["u_foam_fade"] = number(foam.fade)
        uniforms["u_foam_texture_share"] = number(foam.texture)
        inputs |= {
            "u_mask_atlas": TargetInput(target=mask_atlas.ATLAS),
            "u_mask_quantiles": TextureInput(texture=mask_atlas.tables(len(masks), tables)),
        }
        consts |= mask_atlas.consts(mask)
        textures |= mask_atlas.textures([name for name, _ in named], tables)
        targets, passes = mask_atlas.targets(masks), mask_atlas.passes(masks)
    look = f"foam/look/{foam.look}.glsl"
    if masked and cells:
        blended = foam.look == "filtered"
        needs += (*(("foam/cover.glsl",) if blended else ()), Source(look, (("foam_amount", "cell_amount"),)))
        look = "foam/cells_blended.glsl" if blended else "foam/cells.glsl"
    if drift.carries(scene, quality):
        look, own = drift.carried(look, quality)
        needs += own
    if life is not None:
        look, own = living(look, life)
        needs += own
    over = "foam/added.glsl" if foam.look == "listing" else "foam/over.glsl"
    return Contribution(
        why=f"look {foam.look}"
        + (f", mask {foam.mask}" if masked else "")
        + (", turned in each cell" if masked and cells else "")
        + (", carried by the drift" if drift.carries(scene, quality) else "")
        + (", carried and ageing" if lives else ""),
        slots=(
            SlotFile("look", look, needs=needs),
            SlotFile("over", over),
            SlotFile("albedo", "foam/albedo.glsl"),
        ),
        consts=consts,
        uniforms=uniforms,
        inputs=inputs,
        textures=textures,
        targets=targets,
        passes=passes,
        bound=_bound(foam, scene),
    )


def _bound(foam: Foam, scene: Scene) -> Bound | None:
    """What foam can change at most: its amount, as white over black."""
    most = greatest_saturation(foam, scene)
    fields = saturation_fields(foam)
    if most == 0.0:
        return Bound(0.0, "the saturation is 0 everywhere", fields)
    if foam.look == "textured":
        value = min(most, 1.0) * foam_limit(foam, scene)
        fields += ("/foam/albedo", "/light/exposure")
        return Bound(value, f"the saturation is never above {most:.2g}", fields)
    return None


EFFECT = Effect(
    "foam look",
    contribute,
    knobs=(
        Knob("/mask", "format of the mask's thresholds", ("u8", "half", "u16"), "precision"),
        Knob("/foam_taps", "mask texels averaged under minification", (4, 16), "filtering"),
        Knob("/foam_octaves", "maximum octaves of the mask", (1, 2, 3, 4), "filtering"),
    ),
)
