"""Where water is thrown into the air: crests of a sea and of single waves, surf on rocks, and bursts.

docs/formulae.md, section 13.
"""

import math
from dataclasses import dataclass

from seafoam.effects.bounds import parametric_wave_height
from seafoam.effects.effect import Resources, TextureUse
from seafoam.effects.shader import Inline, Piece, SlotRef, constant_function
from seafoam.effects.shore.maps import MASK_WAVES, mask_uniforms
from seafoam.effects.waves.parametric import earlier_wave_files, group_bounds, max_profile_slope
from seafoam.effects.waves.rings import ring_uniforms
from seafoam.effects.waves.sea import BLOCKS, WaterDrawing, drawn_tiles, loop_time
from seafoam.framegraph import rules
from seafoam.ocean.basics.dispersion import angular_frequency
from seafoam.ocean.coast.rocks import ROCKS, rocks
from seafoam.ocean.constants import GRAVITY
from seafoam.ocean.foam import spray as model
from seafoam.ocean.waves.cascades import RAISED, Cascade
from seafoam.ocean.waves.groups import group_velocity
from seafoam.quality import Quality
from seafoam.scene import Scene, Sea, Shore, Spray
from seafoam.sums import summed
from seafoam.textures.shore import SprayRocks

DELAY = 1.5
"""Longest time between the arrival of a crest and the start of a drop, s."""
_EYE_CELLS = 256.0
"""Cells of a grid after which drops repeat."""
_TIMES = "spray/seas.glsl@times"
_SEA_PLACES = Inline(
    "".join(f"uniform float u_sea_size_{tile};\nuniform vec2 u_sea_offset_{tile};\n" for tile in range(RAISED))
)
_NO_RINGS = Inline("float rings_then(vec2 p, float age) {\n    return 0.0;\n}\n")


@dataclass(frozen=True, kw_only=True)
class Births(Resources):
    """What throws water up. ``words``: the same, to be read. ``files``: of the pass that draws births.

    ``function``: of a drop's index, in GLSL. ``beat``: time between batches, s; 0 at rocks, where there are none.
    """

    words: str
    function: str
    files: tuple[Piece | SlotRef, ...]
    beat: float = 0.0


def births(scene: Scene, quality: Quality, spray: Spray) -> Births | None:
    """Return everything that throws water up in a scene."""
    steady = _ashore(scene, quality, spray, scene.shore) if scene.shore else _open(scene, quality, spray)
    sources = [source for source in (_bursts(spray), steady) if source is not None]
    if not sources:
        return None
    # Of two sources each has half of the drops.
    half, first, last = quality.spray_count // 2, sources[0].function, sources[-1].function
    asked = f"{first}(i, drop)" if first == last else f"i < {half} ? {first}(i, drop) : {last}(i - {half}, drop)"
    choice = constant_function("bool", "spray_born", "int i, out Drop drop", asked)
    every = Births(
        words=" and ".join(source.words for source in sources),
        function="spray_born",
        files=(*(file for source in sources for file in source.files), choice),
        beat=0.0 if _on_rocks(scene, spray) else spray.life / model.BATCHES,
    )
    return every.joined(*sources)


def fastest_rise(scene: Scene) -> float:
    """Upper bound of the speed at which parametric waves raise the surface, m/s: all of them at once, in one place."""
    rises = (angular_frequency(wave) * wave.amplitude * max_profile_slope(wave.exponent) for wave in scene.waves)
    travel = math.hypot(*group_velocity(scene)) * group_bounds(scene)[0]
    return summed(rises) + parametric_wave_height(scene) * travel


def _ashore(scene: Scene, quality: Quality, spray: Spray, shore: Shore) -> Births | None:
    """Surf on rocks or, without rocks, on a beach."""
    if shore.surf.height == 0.0:
        return None
    return _rocks(scene, spray, shore) if _on_rocks(scene, spray) else _surf(scene, quality, spray, shore)


def _on_rocks(scene: Scene, spray: Spray) -> bool:
    return scene.shore is not None and scene.shore.surf.height > 0.0 and len(rocks(scene.shore, spray.steep)) > 0


def _surf(scene: Scene, quality: Quality, spray: Spray, shore: Shore) -> Births:
    files, water = _earlier_water(scene, quality, spray, None)
    breaking = ("spray/births.glsl@breaking_surf", "spray/births.glsl@open")
    surf = Births(
        words="surf on a beach",
        function="open_born",
        files=(SlotRef("waves"), *files, "spray/births.glsl@shore_then", *breaking),
        consts={"SPRAY_MOMENT": model.MOMENT},
        uniforms={
            "u_spray_crest_way": rules.vector((1.0, 0.0)),
            "u_spray_torn": rules.number(0.0),
            **_shore_uniforms(shore),
        },
    )
    return surf.joined(water, _grids(spray))


def _rocks(scene: Scene, spray: Spray, shore: Shore) -> Births:
    # At the coast waves are at most 1.2 times their breaking height, by Green's law.
    fastest = spray.speed * math.sqrt(GRAVITY * 1.2 * shore.surf.height / 0.3)
    period = shore.surf.period
    earlier, waves = _earlier(scene)
    surf = Births(
        words=f"surf on rocks starts drops at {fastest:.2g} m/s at most",
        function="rock_born",
        files=(SlotRef("waves"), "spray/births.glsl@shore_then", *earlier, "spray/births.glsl@rocks"),
        consts={"SPRAY_ROCKS": ROCKS, "SPRAY_DELAY": DELAY},
        uniforms={
            "u_spray_surf_time": rules.array(
                "float", [rules.Loop(period=period), rules.Loop(period=period * model.EPOCHS)], 2
            ),
            **_shore_uniforms(shore),
            # A drop's life ends before the next crest arrives.
            "u_spray_surf_life": rules.number(min(spray.life, period - DELAY)),
        },
        textures={"spray_rocks": TextureUse(SprayRocks(shore=shore, steep=spray.steep), wrap="clamp_to_edge")},
    )
    return surf.joined(waves)


def _shore_uniforms(shore: Shore) -> dict[str, rules.Uniform]:
    """What turns a shore's waves back in time."""
    mask = mask_uniforms()
    return {
        "u_spray_period": rules.number(shore.surf.period),
        "u_spray_variation": rules.number(shore.surf.variation),
        "u_spray_mask": mask["u_surf_mask"],
        "u_spray_mask_phase": mask["u_surf_mask_phase"],
        "u_spray_mask_rate": rules.constants(
            "float", (rules.significant(2.0 * math.pi / period) for _, _, period in MASK_WAVES)
        ),
    }


def _open(scene: Scene, quality: Quality, spray: Spray) -> Births | None:
    """Breaking waves of the open water."""
    fastest = fastest_rise(scene)
    fronts = fastest > spray.threshold
    tiles = drawn_tiles(scene, quality)[:RAISED]
    limits = None if scene.sea is None or not tiles else model.fold_limits(scene.sea, spray, scene.water.depth)
    if not fronts and limits is None:
        return None
    parts = {"folds of the sea": limits, f"fronts that rise at {fastest:.2g} m/s at most": fronts}
    words = " and ".join(part for part, there in parts.items() if there)
    files, water = _earlier_water(scene, quality, spray, limits)
    crest, torn, heading, strong = (0.0, 0.0), 0.0, 0.0, 0.0
    if scene.sea is not None and tiles:
        crest, torn = model.crest_velocity(scene.sea), model.torn_share(scene.sea, spray)
        heading, strong = scene.sea.downwind, model.crest_strength(scene.sea)
    breaking = Births(
        words=words,
        function="open_born",
        files=(*files, "spray/births.glsl@breaking", "spray/births.glsl@open"),
        uniforms={
            "u_spray_crest": rules.vector(rules.rounded(crest)),
            "u_spray_crest_way": rules.vector(rules.rounded((math.cos(heading), math.sin(heading)))),
            "u_spray_strong": rules.number(rules.significant(strong)),
            "u_spray_torn": rules.number(rules.significant(torn)),
        },
    )
    return breaking.joined(water, _grids(spray))


def _earlier_water(
    scene: Scene, quality: Quality, spray: Spray, limits: tuple[float, float] | None
) -> tuple[list[Piece | SlotRef], Resources]:
    """Files of the open water at the births of batches, and what they need."""
    earlier, waves = _earlier(scene)
    if scene.sea is None or not drawn_tiles(scene, quality):
        return ["spray/seas.glsl@sea_none", *earlier], waves
    # A shore's files declare the places in the tiles.
    places = [] if scene.shore is not None else [_SEA_PLACES]
    files = ["lib/texels.glsl@cubic_spline", BLOCKS, *places, "spray/seas.glsl@sea_waves", *earlier]
    return files, waves.joined(_seas(scene.sea, quality, spray, drawn_tiles(scene, quality)[:RAISED], limits))


def _earlier(scene: Scene) -> tuple[list[Piece | SlotRef], Resources]:
    raised = [wave for wave in scene.waves if wave.amplitude > 0.0]
    files: list[Piece | SlotRef] = [*(earlier_wave_files(scene) if raised else ("spray/births.glsl@fronts_none",))]
    files += ["waves/rings.glsl@ring", "spray/births.glsl@rings_then"] if scene.rings else [_NO_RINGS]
    uniforms = ring_uniforms(scene, "u_spray_ring") if scene.rings else {}
    if raised:
        uniforms["u_parametric_rate"] = rules.constants("float", map(angular_frequency, raised))
    uniforms["u_wave_groups_velocity"] = rules.vector(rules.rounded(group_velocity(scene)))
    return files, Resources(uniforms=uniforms)


def _grids(spray: Spray) -> Resources:
    """The grids in whose cells drops are born, and the times of batches."""
    step = spray.life / model.BATCHES
    sides = model.cell_sides(spray)
    places: list[rules.Rule] = []
    for side in sides:
        k = 1.0 / side
        places += [rules.Wrap(k=(k, 0.0), period=_EYE_CELLS), rules.Wrap(k=(0.0, k), period=_EYE_CELLS)]
    return Resources(
        consts={
            "SPRAY_BATCHES": model.BATCHES,
            "SPRAY_LEVELS": model.LEVELS,
            "SPRAY_CELLS": model.CELLS,
            "SPRAY_PLACES": model.PLACES,
            "SPRAY_CLUSTER": model.CLUSTER,
            "SPRAY_BESIDE": model.BESIDE,
        },
        uniforms={
            "u_spray_time": rules.array("float", [rules.Loop(period=step), rules.Loop(period=step * model.EPOCHS)], 2),
            "u_spray_step": rules.number(step),
            "u_spray_cell": rules.constants("float", sides),
            "u_spray_eye": rules.array("vec2", places, model.LEVELS),
            "u_spray_reach": rules.number(spray.reach),
        },
    )


def _seas(
    sea: Sea, quality: Quality, spray: Spray, tiles: tuple[Cascade, ...], limits: tuple[float, float] | None
) -> Resources:
    # Half for the widest pixels: errors of storm grow by 1 %, the frame takes 5 % less.
    texels = min(quality.sea_size, model.SEA_TEXELS) // (2 if quality.pixel_width > 3 else 1)
    chops = [tile.choppiness(sea.choppiness) for tile in tiles]
    threshold, width = limits or (-1e3, 1.0)
    scale = [rules.significant(chop * 2.0 * math.pi / tile.size) for chop, tile in zip(chops, tiles, strict=True)]
    shifts = [rules.significant(chop * texels / tile.size) for chop, tile in zip(chops, tiles, strict=True)]
    shared: dict[str, rules.Uniform] = {
        "u_spray_choppiness": rules.vector((shifts[0], shifts[-1])),
        "u_spray_limit": rules.vector((rules.significant(tiles[0].limit), rules.significant(tiles[-1].limit))),
        "u_spray_fold": rules.vector((rules.significant(threshold), rules.significant(1.0 / width))),
    }
    water = WaterDrawing(
        "spray_seas_a",
        "spray_seas_b",
        len(tiles),
        model.BATCHES,
        texels,
        by_wave=("waves at the births of drops", "spray_gerstner", (_TIMES, "spray/seas.glsl@gerstner_pass")),
        by_spectrum=("spectrum at the births of drops", "spray_spectrum", (_TIMES, "spray/seas.glsl@spectrum_pass")),
        transforms="sea at the births of drops",
        uniforms={
            "u_spray_scale": rules.vector((scale[0], scale[-1])),
            # A sea by FFT is drawn anew when a batch is born, not in every frame.
            **({} if sea.model == "gerstner" else loop_time(spray.life / model.BATCHES)),
        },
        read=texels,
        stage="after",
    )
    own = Resources(consts={"SPRAY_TEXELS": texels}, uniforms=shared, inputs={"u_spray_seas": water.target})
    return water.resources(sea, tiles).joined(own)


def _bursts(spray: Spray) -> Births | None:
    bursts = spray.bursts
    if not bursts:
        return None
    state: list[rules.Rule] = []
    for burst in bursts:
        age: rules.Rule = rules.Clamp(offset=-burst.birth, rate=1.0, low=-1.0, high=1000.0)
        if burst.every is not None:
            age = rules.Loop(period=burst.every, offset=-burst.birth)
        state += [*rules.to_camera(*burst.place), age, rules.Constant(value=(burst.height,))]
    return Births(
        words=f"{len(bursts)} burst{'s' if len(bursts) > 1 else ''}",
        function="burst_born",
        files=("spray/births.glsl@bursts",),
        consts={"SPRAY_BURSTS": len(bursts)},
        uniforms={
            "u_spray_burst": rules.array("vec4", state, len(bursts)),
            "u_spray_burst_wide": rules.constants("float", (burst.radius for burst in bursts)),
        },
    )
