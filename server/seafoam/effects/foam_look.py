"""How saturation becomes foam: the paper's looks and the filtered threshold. docs/formulae.md, section 5."""

import math

from seafoam.effects.contribution import (
    Bound,
    Contribution,
    Effect,
    Knob,
    PlanError,
    SlotFile,
    TextureInput,
    TextureUse,
    Uniform,
    Wrap,
    array,
    number,
    vector,
)
from seafoam.effects.extremes import foam_limit, greatest_saturation
from seafoam.masks.catalogue import Mask
from seafoam.quality import Quality
from seafoam.scene.models import Foam, FrontSaturation, HeightSaturation, ParametricWave, Scene
from seafoam.textures import foam_texture, mask_by_name

_MASK_SOURCES = {"u8": "ranks-8", "half": "thresholds-half", "u16": "ranks"}
_TEXTURE_FILE = "foam/texture.glsl"


def _mask(foam: Foam) -> Mask:
    try:
        return mask_by_name(foam.mask)
    except KeyError:
        raise PlanError("/foam/mask", f"no mask is called {foam.mask!r}; GET /api/masks lists them") from None
    except ValueError as error:
        raise PlanError("/foam/mask", str(error)) from None


def _mask_uniforms(foam: Foam) -> dict[str, Uniform]:
    c, s = math.cos(foam.mask_angle) / foam.mask_tile, math.sin(foam.mask_angle) / foam.mask_tile
    return {
        "u_mask_matrix": vector((c, s, -s, c)),
        "u_mask_offset": array("vec2", [Wrap(k=(c, s)), Wrap(k=(-s, c))], 1),
    }


def _texture_uniforms(foam: Foam) -> dict[str, Uniform]:
    scale = 1.0 / foam.texture_tile
    return {
        "u_foam_tile": number(scale),
        "u_foam_offset": array("vec2", [Wrap(k=(scale, 0.0)), Wrap(k=(0.0, scale))], 1),
    }


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by foam."""
    foam = scene.foam
    if foam is None:
        return None
    masked = foam.look != "textured"
    textured = foam.look in ("textured", "halftone_textured", "listing") or (
        foam.look == "filtered" and foam.texture > 0
    )
    needs: tuple[str, ...] = ()
    consts: dict[str, int | float | bool] = {}
    uniforms: dict[str, Uniform] = {"u_foam_albedo": number(foam.albedo, "/foam/albedo")}
    inputs: dict[str, TextureInput] = {}
    textures: dict[str, TextureUse] = {}
    if masked:
        mask = _mask(foam)
        needs += ("foam/mask_coordinates.glsl", f"foam/mask_texel_{quality.mask}.glsl")
        needs += () if foam.look == "filtered" else ("foam/mask_exact.glsl",)
        consts["MASK_SIZE"] = mask.ranks.shape[0]
        uniforms |= _mask_uniforms(foam)
        inputs["u_mask_ranks"] = TextureInput(texture="mask_ranks")
        textures["mask_ranks"] = TextureUse(f"mask/{foam.mask}/{_MASK_SOURCES[quality.mask]}")
    if textured:
        needs += (_TEXTURE_FILE,)
        consts["FOAM_TEXTURE_SIZE"] = foam_texture().shape[0]
        uniforms |= _texture_uniforms(foam)
        inputs["u_foam_texture"] = TextureInput(texture="foam_texture")
        textures["foam_texture"] = TextureUse("foam", filter="linear_mipmap_linear")
    if foam.look == "filtered":
        if not textured:
            needs += ("foam/no_texture.glsl",)
        precise = quality.target == "RGBA32F"
        kind = "float" if precise else "half"
        needs += (f"foam/moments_{kind}.glsl",)
        consts |= {
            "QUANTILES": len(mask.quantile),
            "FOAM_FADES": foam.fade > 0.0,
            "FOAM_TEXTURED": textured,
            "FOAM_TAPS": quality.foam_taps,
        }
        if precise:
            consts["MASK_LEVELS"] = mask.ranks.shape[0].bit_length()
        uniforms["u_foam_fade"] = number(foam.fade)
        uniforms["u_foam_texture_share"] = number(foam.texture)
        inputs |= {
            "u_mask_moments": TextureInput(texture="mask_moments"),
            "u_mask_quantiles": TextureInput(texture="mask_quantiles"),
        }
        textures["mask_moments"] = TextureUse(
            f"mask/{foam.mask}/moments-{kind}", filter="nearest" if precise else "linear_mipmap_linear"
        )
        textures["mask_quantiles"] = TextureUse(f"mask/{foam.mask}/quantiles", wrap="clamp_to_edge")
    over = "foam/added.glsl" if foam.look == "listing" else "foam/over.glsl"
    return Contribution(
        why=f"look {foam.look}" + (f", mask {foam.mask}" if masked else ""),
        slots=(
            SlotFile("look", f"look/{foam.look}.glsl", needs=needs),
            SlotFile("over", over),
            SlotFile("albedo", "foam/albedo.glsl"),
        ),
        consts=consts,
        uniforms=uniforms,
        inputs=dict(inputs),
        textures=textures,
        bound=_bound(foam, scene),
    )


def _bound(foam: Foam, scene: Scene) -> Bound | None:
    """What foam can change at most: its amount, as white over black."""
    most = greatest_saturation(foam, scene)
    fields = tuple(
        f"/foam/saturation/{i}/{name}"
        for i, source in enumerate(foam.saturation)
        for name in ("base", "full")
        if isinstance(source, HeightSaturation)
    )
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
    invisible=(
        Scene(
            waves=(ParametricWave(amplitude=0.5),),
            foam=Foam(saturation=(HeightSaturation(base=0.6, full=1.0),), look="halftone"),
        ),
        Scene(
            waves=(ParametricWave(amplitude=0.5),),
            foam=Foam(saturation=(HeightSaturation(base=0.4999, full=1.4999),), look="textured"),
        ),
        Scene(
            waves=(ParametricWave(amplitude=0.5),),
            foam=Foam(
                saturation=(FrontSaturation(), HeightSaturation(base=0.6, full=1.0)), combine="product", look="filtered"
            ),
        ),
    ),
    knobs=(
        Knob("/mask", "format of the mask's thresholds", ("u8", "half", "u16"), "precision"),
        Knob("/foam_taps", "parts of a footprint that foam averages", (1, 4), "filtering"),
    ),
)
