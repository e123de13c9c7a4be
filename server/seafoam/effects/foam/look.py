"""How saturation becomes foam: the paper's looks and the filtered threshold. docs/formulae.md, section 5."""

import math

from seafoam.effects.bounds import foam_limit, greatest_saturation, saturation_fields
from seafoam.effects.effect import (
    Bound,
    Const,
    Contribution,
    Effect,
    HardCase,
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
from seafoam.scene.models import (
    Camera,
    Foam,
    FrontSaturation,
    HeightSaturation,
    Light,
    ParametricWave,
    Scene,
    Water,
)
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
        raise PlanError(pointer, f"no mask is called {name!r}; GET /api/masks lists them") from None
    except ValueError as error:
        raise PlanError(pointer, str(error)) from None


def _masks(foam: Foam) -> list[tuple[str, Mask]]:
    """The foam's masks, those of older foam last; without those that are of another size than the first."""
    first = _mask(foam.mask, "/foam/mask")
    if foam.life is None or foam.look != "filtered":
        return [(foam.mask, first)]
    older = [(name, _mask(name, f"/foam/life/masks/{i}")) for i, name in enumerate(foam.life.masks)]
    return [(foam.mask, first), *((name, mask) for name, mask in older if mask.ranks.shape == first.ranks.shape)]


def _mask_uniforms(foam: Foam) -> dict[str, Uniform]:
    c, s = math.cos(foam.mask_angle) / foam.mask_tile, math.sin(foam.mask_angle) / foam.mask_tile
    return {
        "u_mask_matrix": vector((c, s, -s, c)),
        "u_mask_offset": array("vec2", [Wrap(k=(c, s)), Wrap(k=(-s, c))], 1),
    }


def _carried_uniforms(foam: Foam, drift: tuple[float, float]) -> dict[str, Uniform]:
    """The mask's turn, and the eye's place on a mask that drifts (x, z) m/s."""
    c, s = math.cos(foam.mask_angle) / foam.mask_tile, math.sin(foam.mask_angle) / foam.mask_tile
    turn = 2.0 * math.pi
    rates = -turn * (c * drift[0] + s * drift[1]), -turn * (c * drift[1] - s * drift[0])
    return {
        "u_mask_matrix": vector((c, s, -s, c)),
        "u_mask_phase": array(
            "float",
            [
                Phase(offset=0.0, rate=rates[0], k=(turn * c, turn * s)),
                Phase(offset=0.0, rate=rates[1], k=(-turn * s, turn * c)),
            ],
            2,
        ),
    }


def _cell_uniforms(foam: Foam) -> dict[str, Uniform]:
    """The mask's turn, and the eye's place on the lattice of cells: whole steps apart from the rest."""
    c, s = math.cos(foam.mask_angle) / foam.mask_tile, math.sin(foam.mask_angle) / foam.mask_tile
    # Tiles to steps along the two sides of the triangles.
    first = (c + s / math.sqrt(3.0), s - c / math.sqrt(3.0))
    second = (-2.0 / math.sqrt(3.0) * s, 2.0 / math.sqrt(3.0) * c)
    return {
        "u_mask_matrix": vector((c, s, -s, c)),
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
            if foam.cells
            else ("foam/mask_carried.glsl" if lives else "foam/mask_coordinates.glsl",)
        )
        consts["MASK_SIZE"] = mask.ranks.shape[0]
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
        if not textured:
            needs += (_NO_TEXTURE,)
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
    look = f"look/{foam.look}.glsl"
    if masked and cells:
        needs += (Source(look, (("foam_amount", "cell_amount"),)),)
        look = "foam/cells_blended.glsl" if foam.look == "filtered" else "foam/cells.glsl"
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
        Knob("/foam_taps", "texels of the mask that a small footprint averages", (4, 16), "filtering"),
        Knob("/foam_octaves", "octaves of the mask at most", (1, 2, 3, 4), "filtering"),
    ),
    hard_cases=(
        HardCase(
            name="filtered, a hair above nothing",
            scene=Scene(
                foam=Foam(saturation=(HeightSaturation(base=-6.103515625e-05, full=0.99993896484375),), look="filtered")
            ),
            guard="none at 0 and all at 1, by a step of 1/256 at either end (look/filtered.glsl)",
            without="3.3 levels too bright in the mean where there should be next to no foam",
            camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.12),
        ),
        HardCase(
            name="filtered, a hair below all",
            scene=Scene(
                foam=Foam(saturation=(HeightSaturation(base=-0.99993896484375, full=6.103515625e-05),), look="filtered")
            ),
            guard="none at 0 and all at 1, by a step of 1/256 at either end (look/filtered.glsl)",
            without="holes by rounding: 0 levels on llvmpipe",
            camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.12),
        ),
        HardCase(
            name="thresholds next to 0 and to 1",
            scene=Scene(
                foam=Foam(
                    saturation=(HeightSaturation(base=-1.52587890625e-05, full=0.9999847412109375),), look="halftone"
                )
            ),
            guard="thresholds stand in the middle of their ranks, (rank + 1/2)/N (foam/mask_texel_u16.glsl)",
            without="threshold 0 of the lowest rank: foam at one texel of 262 144 however small f is",
            camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.12),
        ),
        HardCase(
            name="a mask at a thousandth of a texel a pixel",
            scene=Scene(
                foam=Foam(saturation=(HeightSaturation(base=-0.5, full=0.5),), look="filtered", mask_tile=1000.0)
            ),
            guard="the edge's half width at least 5e-4 of a threshold (look/filtered.glsl)",
            without="nothing on llvmpipe: 0/0 where the mask is level under a footprint, and here it is nowhere",
            camera=Camera(position=(0.0, 0.1, 0.0), pitch=-math.pi / 2),
        ),
        HardCase(
            name="a mask at a thousand texels a pixel",
            scene=Scene(
                foam=Foam(saturation=(HeightSaturation(base=-0.5, full=0.5),), look="filtered", mask_tile=0.05)
            ),
            guard="no level past the last, one texel for all of the mask (look/filtered.glsl)",
            without="no such level: every sample off by 242 levels",
            camera=Camera(position=(0.0, 5.0, 0.0), pitch=-math.pi / 2),
        ),
        HardCase(
            name="needles: footprints of a tenth of a texel by a thousand",
            scene=Scene(
                foam=Foam(
                    saturation=(HeightSaturation(base=-0.4, full=0.6),), look="filtered", mask="vac-1.5", mask_tile=1.0
                )
            ),
            guard="no level before the mask's own; the box at least a hundredth of a texel wide (look/filtered.glsl)",
            without="3.4 levels off in the mean, by up to 105: texels of levels that there are not",
            camera=Camera(position=(0.3, 0.02, 0.1), pitch=-0.01),
        ),
        HardCase(
            name="a fade too small for float32",
            scene=Scene(waves=(ParametricWave(),), foam=Foam(fade=1e-40), light=None),
            guard="the ramp's divisor at least 1e-30 (look/filtered.glsl)",
            without="NaN in 67 % of samples: subnormals are flushed, 0/0",
            camera=Camera(position=(0.37, 1.2, -0.21), yaw=1.0, pitch=-0.12),
        ),
        HardCase(
            name="four octaves, a hair below all",
            scene=Scene(
                foam=Foam(
                    saturation=(HeightSaturation(base=-0.99993896484375, full=6.103515625e-05),),
                    look="filtered",
                    mask="lace",
                    octaves=4,
                )
            ),
            guard="no octave after one that left all or nothing (look/filtered.glsl)",
            without="nothing on llvmpipe: ramps end at all and at nothing exactly",
            camera=Camera(position=(0.37, 0.3, -0.21), yaw=1.0, pitch=-0.3),
        ),
        HardCase(
            name="four octaves, ten thousand kilometres away",
            scene=Scene(
                foam=Foam(
                    saturation=(HeightSaturation(base=-0.4, full=0.6),),
                    look="filtered",
                    mask="lace",
                    octaves=4,
                    mask_tile=0.7,
                )
            ),
            guard="places modulo a tile before each octave, which whole numbers map onto itself (look/filtered.glsl)",
            without="0.12 levels at the most: far places lose hundredths of a texel of the finest octave",
            camera=Camera(position=(9.99e6, 0.4, -9.99e6), yaw=1.0, pitch=-0.5),
        ),
        HardCase(
            name="a mask turned in each cell, ten thousand kilometres away",
            scene=Scene(
                foam=Foam(
                    saturation=(HeightSaturation(base=-0.4, full=0.6),), look="filtered", cells=True, mask_tile=0.7
                )
            ),
            guard="whole cells and the rest of the eye's place apart, both reduced in float64 (effects/foam/look.py)",
            without="in float32 the place within a cell is lost: every turn of the mask is another",
            camera=Camera(position=(9.99e6, 2.4, -9.99e6), yaw=1.0, pitch=-0.5),
        ),
        HardCase(
            name="a mask turned in each cell, a hair below all",
            scene=Scene(
                waves=(ParametricWave(amplitude=1e-3, wavelength=3.0),),
                foam=Foam(saturation=(HeightSaturation(base=-0.9995, full=0.0005),), cells=True, mask_tile=1.5),
                light=None,
            ),
            guard="what is left free held at 1/256 under the power and led to 0 evenly (foam/cells_blended.glsl)",
            without="the power's slope is endless at 0: foam off by 0.28 where s is 1 to rounding",
            camera=Camera(position=(0.37, 3.0, -0.21), pitch=-math.pi / 2),
        ),
        HardCase(
            name="a mask turned in each cell, its thresholds hard",
            scene=Scene(
                foam=Foam(
                    saturation=(HeightSaturation(base=-0.4, full=0.6),),
                    look="halftone_textured",
                    cells=True,
                    mask_tile=4.0,
                    texture_tile=2.7,
                    texture_second=3.14,
                )
            ),
            guard="the nearest cell alone, its weight never 0 (foam/cells.glsl)",
            without="blended, thresholds soften: 4 amounts instead of 2 where cells meet",
            camera=Camera(position=(3.0, 1.6, -9.0), yaw=2.0, pitch=-0.5),
        ),
        HardCase(
            name="black foam over the brightest glitter",
            scene=Scene(
                foam=Foam(
                    saturation=(HeightSaturation(base=-0.99, full=0.01),), mask_tile=1000.0, fade=0.1, albedo=0.0
                ),
                water=Water(roughness=0.03),
                light=Light(sun_elevation=0.3, exposure=10.0, visibility=1e6),
            ),
            guard="the share held in [0, 1] (look/filtered.glsl)",
            without="the share passes 1 by its rounding: light of -3.1 in 6 % of samples",
            camera=Camera(position=(3.0, 0.3, 0.0), yaw=math.pi / 2, pitch=-0.3, fov=0.3),
        ),
        HardCase(
            name="a foam texture far under a texel",
            scene=Scene(
                foam=Foam(saturation=(HeightSaturation(base=-1.0, full=1.0),), look="textured", texture_tile=1000.0)
            ),
            guard="texels held at 1e-6 before the logarithm (foam/texture.glsl)",
            without="nothing on llvmpipe: log2(0) is -infinity and the level is held at 0",
            camera=Camera(position=(0.37, 1e-3, -0.21), pitch=-0.3),
        ),
    ),
)
