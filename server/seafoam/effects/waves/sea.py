"""The open sea from a wind spectrum: tiles drawn every frame, by FFT or wave by wave. docs/formulae.md, section 2."""

import cmath
import math
from collections.abc import Sequence

from seafoam.effects.bounds import crest_limit, slope_sensitivity, surface_top, surface_trough
from seafoam.effects.effect import (
    HALF_FLOAT,
    Bound,
    Contribution,
    Effect,
    Knob,
    PassSpec,
    SlotFile,
    TextureUse,
)
from seafoam.effects.foam.living import carries
from seafoam.effects.waves.measured import measured_bounds
from seafoam.framegraph.resources import MIPMAPPED, FixedSize, Target, TargetInput, TextureInput
from seafoam.framegraph.rules import Constant, Loop, Phase, Uniform, Wrap, array, number, significant, vector
from seafoam.ocean.cascades import BAND, LEAST_JACOBIAN, LOOP, RAISED, Cascade, cascades
from seafoam.quality import Quality
from seafoam.scene.models import Scene
from seafoam.scene.waves import Sea
from seafoam.textures import sea_spectrum_name

FOLDING_WIND = 7.0
"""Under this wind, m/s, hardly a wave folds (whitecaps cover less than 0.3 %, Monahan and O'Muircheartaigh 1980)."""
CALM_SIZE = 256
"""Texels that a tile of such a sea has at most where footprints take short waves out: with 512 it was no nearer to the
truth (swell 4.78 for 4.56 levels, explosion 24.3 for 23.0) and took up to twice the time."""
NEWTON = 2
"""Newton steps from a corner of the tile to the water that rests under it."""
RESAMPLED = ("lib/cubic_spline.glsl", "waves/sea/resample_pass.glsl")
"""Where the water that is at a place rests, and what it has brought along."""
TWIDDLES = {"fft_twiddles": TextureUse("fft-twiddles", wrap="clamp_to_edge")}


def transform(name: str, first: str, second: str, size: int) -> tuple[tuple[PassSpec, ...], str]:
    """Passes that transform the blocks of ``first``, between it and ``second``; and the target they end in."""
    radices = {64: (8, 8), 32: (8, 4), 128: (8, 4, 4), 256: (8, 8, 4), 512: (8, 8, 8)}[size]
    passes = []
    source, other = first, second
    for axis in (0, 1):
        span = 1
        for radix in radices:
            passes.append(
                PassSpec(
                    name=f"{name}: {'columns' if axis else 'rows'}, {span} to {span * radix}",
                    program=f"fft_{radix}",
                    fragment=(f"waves/sea/radix_{radix}.glsl", "waves/sea/fft_pass.glsl"),
                    target=other,
                    inputs={
                        "u_fft_from": TargetInput(target=source),
                        "u_fft_twiddles": TextureInput(texture="fft_twiddles"),
                    },
                    uniforms={"u_fft": vector((float(size), float(span), float(axis)))},
                )
            )
            source, other = other, source
            span *= radix
    return tuple(passes), source


def loop_uniforms() -> dict[str, Uniform]:
    """The moment's place in the loop, whole and within its 1024th part."""
    return {
        "u_sea_loop": Uniform(type="float", rules=(Loop(period=LOOP),)),
        "u_sea_fine": Uniform(type="float", rules=(Loop(period=LOOP / 1024.0),)),
    }


def gerstner_uniforms(tiles: Sequence[Cascade], size: int) -> dict[str, Uniform]:
    """The waves of tiles that are summed wave by wave. ``size``: texels of the splines that are drawn; 0: none."""
    data, phases = [], []
    for of, (row, column) in ((tile, place) for tile in tiles for place in tile.waves):
        iz, ix = row - BAND, column - BAND
        h0 = complex(of.h0[row, column])
        omega = 2.0 * math.pi / LOOP * int(of.turns[row, column])
        response = math.prod((2.0 + math.cos(2.0 * math.pi * i / size)) / 3.0 for i in (ix, iz)) if size else 1.0
        data.append(Constant(value=(ix, iz, significant(2.0 * abs(h0) / response), significant(omega))))
        phases.append(Phase(offset=significant(cmath.phase(h0)), rate=-omega, k=(0.0, 0.0)))
    if not data:
        # GLSL has no array of none: a wave of no height stands in it.
        data, phases = [Constant(value=(1.0, 0.0, 0.0, 0.0))], [Phase(offset=0.0, rate=0.0, k=(0.0, 0.0))]
    return {
        "u_gerstner": array("vec4", data, len(data)),
        "u_gerstner_phase": array("float", phases, len(data)),
    }


def tile_uniforms(of: Cascade, number_of: int, wanted: float, size: int) -> dict[str, Uniform]:
    """What turns displaced water into a height field."""
    return {
        "u_sea_block": number(float(number_of)),
        "u_sea_texel": number(significant(of.size / size)),
        "u_sea_choppiness": number(significant(of.choppiness(wanted))),
        "u_sea_limit": vector((significant(of.limit), significant(of.steepest))),
    }


def fitted(sea: Sea, quality: Quality) -> Quality:
    """The quality with no more texels a tile than show in this sea."""
    if sea.wind >= FOLDING_WIND or not quality.surface.filter or quality.sea_size <= CALM_SIZE:
        return quality
    return quality.model_copy(update={"sea_size": CALM_SIZE})


def displaced_target(scene: Scene, quality: Quality) -> str:
    """Name of the target that holds the displaced water."""
    if scene.sea is None or scene.sea.model == "gerstner":
        return "sea_a"
    return transform("sea", "sea_a", "sea_b", fitted(scene.sea, quality).sea_size)[1]


def tile_target(quality: Quality, size: int) -> Target:
    """A tile that the surface reads between its texels."""
    fine = quality.sea_digits == "float"
    return Target(
        size=FixedSize(width=size, height=size),
        format="RGBA32F" if fine else "RGBA16F",
        filter="nearest" if fine else "linear",
        wrap="repeat",
    )


def drawn(scene: Scene, quality: Quality) -> tuple[Cascade, ...]:
    """The tiles that a quality draws of the scene's sea."""
    if scene.sea is None or scene.sea.wind <= 0.0:
        return ()
    return cascades(scene.sea, scene.water.depth)[: quality.sea_tiles]


def _offset(of: Cascade) -> Uniform:
    return array("vec2", [Wrap(k=(1.0 / of.size, 0.0)), Wrap(k=(0.0, 1.0 / of.size))], 1)


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by ``sea``."""
    sea = scene.sea
    if sea is None:
        return None
    tiles = drawn(scene, quality)
    if not tiles:
        return Contribution(why="", bound=Bound(0.0, "no wind, so no waves"))
    gerstner = sea.model == "gerstner"
    size = fitted(sea, quality).sea_size
    raised = tiles[:RAISED]
    displaced = displaced_target(scene, quality)
    float_target = Target(size=FixedSize(width=size * len(tiles), height=size), format="RGBA32F")
    targets = {"sea_a": float_target}
    passes: tuple[PassSpec, ...]
    textures: dict[str, TextureUse] = {}
    if gerstner:
        passes = (
            PassSpec(
                name="waves of the sea",
                program="gerstner",
                fragment=("lib/numbers.glsl", "waves/sea/gerstner.glsl", "waves/sea/gerstner_pass.glsl"),
                target="sea_a",
                uniforms=gerstner_uniforms(tiles, size),
            ),
        )
    else:
        targets["sea_b"] = float_target
        textures = {
            "sea_spectrum": TextureUse(sea_spectrum_name(sea, scene.water.depth), wrap="clamp_to_edge"),
            **TWIDDLES,
        }
        first = PassSpec(
            name="spectrum of the sea",
            program="sea_spectrum",
            fragment=("lib/numbers.glsl", "waves/sea/spectrum.glsl", "waves/sea/displaced_pass.glsl"),
            target="sea_a",
            inputs={"u_sea_spectrum": TextureInput(texture="sea_spectrum")},
            uniforms=loop_uniforms(),
        )
        passes = (first, *transform("sea", "sea_a", "sea_b", size)[0])
    for i, of in enumerate(tiles):
        targets[f"sea_tile_{i}"] = tile_target(quality, size)
        passes += (
            PassSpec(
                name=f"sea, {of.size:g} m tile",
                program="sea_tile",
                fragment=(*RESAMPLED, "waves/sea/tile_pass.glsl"),
                target=f"sea_tile_{i}",
                inputs={"u_sea_displaced": TargetInput(target=displaced)},
                uniforms=tile_uniforms(of, i, sea.choppiness, size),
            ),
        )
        if i < RAISED:
            found, measured = measured_bounds(f"sea_tile_{i}", size, of.size / size)
            targets |= found
            passes += measured
    fetch = (
        ("lib/bilinear.glsl", "lib/cubic_spline.glsl", "waves/sea/fetch_exact.glsl")
        if quality.sea_digits == "float"
        else ("lib/cubic_spline.glsl", "waves/sea/fetch_linear.glsl")
    )
    seen = "sea_seen" if quality.surface.filter else "sea_tile"
    if quality.surface.filter:
        for i, of in enumerate(tiles):
            targets[f"sea_seen_{i}"] = Target(
                size=FixedSize(width=2 * size, height=2 * size),
                format="RGBA16F",
                filter=MIPMAPPED,
                wrap="repeat",
            )
            passes += (
                PassSpec(
                    name=f"sea, {of.size:g} m tile as seen",
                    program="sea_seen",
                    fragment=(*fetch, "waves/sea/seen_pass.glsl"),
                    target=f"sea_seen_{i}",
                    inputs={"u_sea_full": TargetInput(target=f"sea_tile_{i}")},
                ),
            )
    needs = (*fetch, "waves/sea/level.glsl", f"waves/sea/seen{'' if quality.surface.filter else '_exact'}.glsl")
    slots = [
        SlotFile("waves", "waves/sea.glsl", prefix="sea", needs=needs),
        SlotFile("bounds", "waves/sea/bounds.glsl", prefix="sea"),
    ]
    if scene.shore is None:
        slots.append(SlotFile("short", "waves/sea/short.glsl"))
        slots.append(SlotFile("short bounds", "waves/sea/short_bounds.glsl", needs=("waves/sea/bounds.glsl",)))
    if len(tiles) > RAISED:
        name = "detail_two" if len(tiles) == 4 else "detail_one"
        slots.append(SlotFile("detail", f"waves/sea/{name}.glsl", prefix="sea", needs=needs))
    orbits: dict[str, TextureInput | TargetInput] = {}
    if carries(scene):
        slots.append(SlotFile("carry", "foam/carry/sea.glsl", prefix="sea"))
        side = size // 2
        over = FixedSize(width=side, height=RAISED * (side + 1))
        targets["sea_orbits"] = tile_target(quality, side).model_copy(update={"size": over})
        orbits["u_sea_orbits"] = TargetInput(target="sea_orbits")
        passes += tuple(
            PassSpec(
                name=f"orbits, {of.size:g} m tile",
                program="sea_orbit",
                fragment=(*RESAMPLED, "foam/carry/sea_orbit_pass.glsl"),
                target="sea_orbits",
                inputs={"u_sea_displaced": TargetInput(target=displaced)},
                uniforms=tile_uniforms(of, i, sea.choppiness, size),
            )
            for i, of in enumerate(raised)
        )
    top = sum(of.limit for of in raised)
    steepest = sum(of.steepest for of in raised)
    height = 4.0 * math.sqrt(sum(of.variance for of in tiles))
    waves = sum(len(of.waves) for of in tiles)
    how = f"{waves} waves on {len(tiles)} tiles" if gerstner else f"{len(tiles)} tiles by FFT, {size}²"
    return Contribution(
        why=f"sea of {sea.wind:g} m/s wind, significant height {height:.3g} m: {how}",
        slots=tuple(slots),
        consts={
            "SEA_SIZE": size,
            "SEA_BAND": BAND,
            "SEA_LOOP": LOOP,
            "SEA_NEWTON": NEWTON if sea.choppiness > 0.0 else 0,
            "SEA_LEAST_JACOBIAN": LEAST_JACOBIAN,
            "SEA_LEVELS": size.bit_length() - 4,
            "GERSTNER_WAVES": max(waves, 1) if gerstner else 2,
            "GERSTNER_FIRST": len(tiles[0].waves) if gerstner else 1,
        },
        uniforms={
            **{f"u_sea_offset_{i}": _offset(of) for i, of in enumerate(tiles)},
            **{f"u_sea_size_{i}": number(of.size) for i, of in enumerate(tiles)},
        },
        inputs={
            **{f"u_sea_bounds_{i}": TargetInput(target=f"sea_tile_{i}_bounds") for i in range(RAISED)},
            **{f"u_sea_tile_{i}": TargetInput(target=f"sea_tile_{i}") for i in range(RAISED)},
            **{f"u_sea_seen_{i}": TargetInput(target=f"{seen}_{i}") for i in range(len(tiles))},
            **orbits,
        },
        textures=textures,
        targets=targets,
        passes=passes,
        bound=_bound(scene, sum(of.steepest for of in tiles)),
        top=top,
        trough=-top,
        steepest=steepest,
        grain=sum(of.grain(size) + of.limit * HALF_FLOAT for of in raised),
        march=2,
    )


def _bound(scene: Scene, steepest: float) -> Bound | None:
    """As of parametric waves: without foam, ripples and floor only slopes show."""
    ripples = scene.water.chop is not None and scene.light is not None
    if scene.foam is not None or ripples or scene.water.depth is not None or scene.boats:
        return None
    if scene.light is None:
        return Bound(0.0, "nothing lies on it, and there is no light")
    return Bound(
        slope_sensitivity(scene) * steepest + 0.1 * (surface_top(scene) - surface_trough(scene)) + crest_limit(scene),
        f"slopes are never above {steepest:.1g}",
        ("/light/exposure", "/water/roughness", "/water/translucency", "/water/absorption_length"),
    )


EFFECT = Effect(
    "sea",
    contribute,
    knobs=(
        Knob("/sea_size", "texels of a sea tile", (64, 128, 256, 512), "geometry"),
        Knob("/sea_tiles", "sea tiles", (2, 3, 4), "geometry"),
        Knob("/sea_digits", "number format of the sea tiles", ("half", "float"), "precision"),
    ),
)
