"""The open sea from a wind spectrum: tiles drawn every frame, by FFT or wave by wave. docs/formulae.md, section 2."""

import cmath
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import cycle, islice
from typing import Literal

from seafoam.effects import effect
from seafoam.effects.bounds import measured_bounds, unlit
from seafoam.effects.effect import Contribution, PassSpec, QualityParameter, Resources, TextureUse, drawn_map
from seafoam.effects.shader import Const, Inline, Piece, SlotFile
from seafoam.framegraph.resources import MIPMAPPED, FixedSize, Target, TargetFormat
from seafoam.framegraph.rules import Loop, Phase, Uniform, array, constants, in_tile, number, significant, vector
from seafoam.ocean.waves.cascades import BAND, LEAST_JACOBIAN, LOOP, RAISED, Cascade, cascades
from seafoam.ocean.waves.stokes import follows_orbits
from seafoam.quality import Quality
from seafoam.scene import Scene, Sea, WhitecapSaturation
from seafoam.sums import summed
from seafoam.textures.waves import FftTwiddles, SeaSpectrum

WHITECAP_WIND = 7.0
"""Wind, m/s, below which whitecaps cover less than 0.3 % (Monahan and O'Muircheartaigh 1980)."""
HIDDEN = 0.43
"""Root mean square slope of the finest tiles, in the water's roughness, up to which they are hardly seen at a quarter
of the width: without them ``fast`` errs 0.6 (storm) to 1 % more, for 0.85 to 0.87 of the time."""
CALM_SIZE = 256
"""Maximum number of texels along a tile below that wind, or without whitecaps and with one sample a pixel, if
footprints filter short waves: with 512, the error against the reference was no smaller (lake-choppy 10.2 instead of 9.7
levels, swell 4.78 instead of 4.56, explosion 24.3 instead of 23.0) and the time longer. Foam by folds does need them:
crests are up to three times narrower than their waves, and half of the error of open-ocean was foam out of place."""
NEWTON, NEWTON_WIDE = 2, 1
"""Newton steps that invert the horizontal displacement at a texel, and those for wide pixels, whose errors stay the
same (storm 7.6 and 7.5 levels, open-ocean 10.9 and 11.0)."""
READ, READ_ALONE = 0.57735, 0.75
"""Side of a trilinear read of slopes over that of the footprint: of the same variance, and of the least error where one
sample stands for a pixel. Against 256 samples of seas of 4 to 15 m/s, single ones had 1.26 to 1.55 and 0.91 to 1.32
times the error of 16."""
_PASSES = "waves/sea_passes.glsl@"
_COMPLEX, _FOUR = f"{_PASSES}complex", f"{_PASSES}four"
DISPLACED = "sea_a"
"""The target with the displacements of the water."""
BLOCKS = f"{_PASSES}blocks"
"""File that reads blocks of water."""
_RESAMPLED = ("lib/texels.glsl@cubic_spline", BLOCKS, f"{_PASSES}resample_pass")


@dataclass(frozen=True)
class WaterDrawing:
    """Passes that draw the water of a sea, as blocks of a target: over one another, a quarter of each in each layer.

    ``target``: it holds the result; the Fourier transforms alternate between it and ``second``. ``times``: blocks for
    each of ``tiles`` tiles, one after the other. ``size``: side of a block, texels. ``by_wave``, ``by_spectrum``:
    name, program and files of the first pass, for a sea whose waves are summed and for one by FFT. ``transforms``: in
    the names of these passes. ``uniforms``: of the first pass. ``read``: texels along a tile of what is then read by
    B-spline, or 0. ``format``: of all targets; half floats suffice for thresholds.
    """

    target: str
    second: str
    tiles: int
    times: int
    size: int
    by_wave: tuple[str, str, tuple[Piece, ...]]
    by_spectrum: tuple[str, str, tuple[Piece, ...]]
    transforms: str
    uniforms: dict[str, Uniform] = field(default_factory=dict)
    read: int = 0
    format: TargetFormat = "RGBA32F"
    stage: Literal["before", "after"] = "before"

    def resources(self, sea: Sea, tiles: Sequence[Cascade]) -> Resources:
        """Return targets and passes of the waves of ``tiles``."""
        if sea.model == "gerstner":
            uniforms = _gerstner_uniforms(tiles, self.read)
            first = self._first(self.by_wave, ("gerstner", "water_pass"), uniforms, self.target)
            return Resources(targets={self.target: self._layers(self.size, self.size // 4)}, passes=(first,))
        side = min(2 * BAND, self.size)
        spectra, *rows = f"{self.target}_spectra", f"{self.target}_rows", f"{self.second}_rows"
        columns = self.second, self.target
        first = self._first(self.by_spectrum, ("spectrum", "spectra_pass"), loop_time(), spectra)
        return Resources(
            targets={
                spectra: self._layers(side // 4, side),
                **dict.fromkeys(rows, self._layers(self.size // 4, side)),
                **dict.fromkeys(columns, self._layers(self.size, self.size // 4)),
            },
            passes=(first, *self._fft(spectra, rows, columns)),
        )

    def _layers(self, width: int, rows: int) -> Target:
        """``rows``: of each block in a layer."""
        size = FixedSize(width=width, height=self.tiles * self.times * rows)
        return Target(size=size, format=self.format, layers=4)

    def _first(
        self,
        called: tuple[str, str, tuple[Piece, ...]],
        files: tuple[str, str],
        uniforms: dict[str, Uniform],
        target: str,
    ) -> PassSpec:
        (name, program, own), (waves, last) = called, files
        sizes = Inline(f"const int BLOCK_SIZE = {self.size};\nconst int BLOCK_TIMES = {self.times};\n")
        fragment = ("lib/numbers.glsl", _COMPLEX, sizes, f"{_PASSES}{waves}", *own, _FOUR, f"{_PASSES}{last}")
        return PassSpec(name, program, fragment, {}, {**uniforms, **self.uniforms}, target, stage=self.stage)

    def _fft(self, spectra: str, rows: Sequence[str], columns: Sequence[str]) -> Iterator[PassSpec]:
        """Passes that transform the blocks, as many along each axis: the last draws into the last of ``columns``."""
        bits = int(math.log2(self.size))
        steps = range(0, bits, 2)
        spreads = self.size > 2 * BAND
        source = spectra
        for axis, (kind, targets) in enumerate((("rows", rows), ("columns", columns))):
            for step, target in zip(steps, list(islice(cycle(targets[::-1]), len(steps)))[::-1], strict=True):
                radix, last = min(4, 1 << (bits - step)), "fft_last_pass" if bits - step == 1 else "fft_pass"
                first = Inline(f"const bool FFT_SPREADS = {str(spreads).lower()};\n"), f"{_PASSES}fft_first_pass"
                name = f"{self.transforms}: {kind}, {1 << step} to {radix << step}"
                program = f"fft_{radix}" if step else "fft_spread" if spreads else "fft_first"
                files = (_COMPLEX, _FOUR, f"{_PASSES}fft", *((f"{_PASSES}{last}",) if step else first))
                uniforms = {"u_fft": vector((float(bits), float(step), float(axis)))}
                yield PassSpec(name, program, files, {"u_fft_from": source}, uniforms, target, stage=self.stage)
                source = target


def loop_time(step: float | None = None) -> dict[str, Uniform]:
    """Time in the loop, s, modulo the loop and modulo its 1024th part. ``step``: that of the last multiple of it."""
    periods = {"u_sea_loop": LOOP, "u_sea_fine": LOOP / 1024.0}
    return {name: array("float", [Loop(period=period, step=step)], 1) for name, period in periods.items()}


def _gerstner_uniforms(tiles: Sequence[Cascade], size: int) -> dict[str, Uniform]:
    """Waves of tiles that are summed wave by wave. ``size``: texels along a tile read by B-spline; 0: not so read."""
    data: list[tuple[float, ...]] = []
    phases: list[Phase] = []
    for tile, row, column in ((cascade, *indices) for cascade in tiles for indices in cascade.waves):
        iz, ix = row - BAND, column - BAND
        h0 = complex(tile.h0[row, column])
        omega = 2.0 * math.pi / LOOP * int(tile.turns[row, column])
        response = math.prod((2.0 + math.cos(2.0 * math.pi * i / size)) / 3.0 for i in (ix, iz)) if size else 1.0
        data.append((ix, iz, significant(2.0 * abs(h0) / response), significant(omega)))
        phases.append(Phase(offset=significant(cmath.phase(h0)), rate=-omega, k=(0.0, 0.0)))
    if not data:
        # GLSL has no empty arrays, so the array contains a wave of height 0.
        data, phases = [(1.0, 0.0, 0.0, 0.0)], [Phase(offset=0.0, rate=0.0, k=(0.0, 0.0))]
    return {"u_gerstner": constants("vec4", data), "u_gerstner_phase": array("float", phases, len(data))}


def tile_block(sea: Sea, tile: Cascade, index: int, quality: Quality) -> Uniform:
    """Return the uniform by which passes find a tile in the map of displaced water. ``index``: of the tile's block."""
    texel = tile.size / displaced_size(quality)
    return vector((float(index), significant(texel), significant(tile.choppiness(sea.choppiness))))


def raised_blocks(sea: Sea, raised: Sequence[Cascade], quality: Quality) -> dict[str, Uniform]:
    """Uniforms of passes over the tiles that displace the surface, the first and, if there is one, the second."""
    blocks = [tile_block(sea, tile, i, quality) for i, tile in enumerate(raised)]
    return {"u_sea_block": blocks[0], "u_sea_other": blocks[-1]}


def resampled(scene: Scene, quality: Quality) -> tuple[str, ...]:
    """Return files that find the rest position of the water at a place, and what moves with it.

    They begin from the map of orbits, which is as exact as two Newton steps, where there is one.
    """
    if follows_orbits(scene) and quality.sea_digits == "half":
        return (*_RESAMPLED, "waves/sea_passes.glsl@fetch_linear", "waves/sea_passes.glsl@resting_found")
    return (*_RESAMPLED, "waves/sea_passes.glsl@resting")


def sea_quality(scene: Scene, quality: Quality) -> Quality:
    """Return the quality with no more texels along a tile than make a visible difference in the scene."""
    breaks = scene.sea is not None and scene.sea.wind_speed >= WHITECAP_WIND
    foams = scene.foam is not None and scene.foam.source(WhitecapSaturation) is not None
    if (breaks and (foams or quality.samples > 1)) or not quality.surface.filter or quality.sea_size <= CALM_SIZE:
        return quality
    return quality.model_copy(update={"sea_size": CALM_SIZE})


def displaced_size(quality: Quality) -> int:
    """Return the side of the map of displaced water, texels: four a wave are enough for its spline.

    Not so for the height field, whose crests are narrower.
    """
    return quality.sea_size if quality.sea_digits == "float" else min(quality.sea_size, 4 * BAND)


def _smoothed(quality: Quality) -> bool:
    """Whether the texels of all tiles are so few that a B-spline stands between them."""
    return quality.sea_digits == "float" or quality.sea_size <= 4 * BAND


def seen_size(quality: Quality) -> int:
    """Return the side of a tile's map for shading, texels: where they are few, spline points stand between them.

    Not so for wide pixels, whose errors are hardly less for these (open-ocean 11.1 levels with, 11.2 without, against
    ``high`` at 512 × 288).
    """
    return 2 * quality.sea_size if _smoothed(quality) and quality.pixel_width == 1 else quality.sea_size


def detail_size(quality: Quality) -> int:
    """Return the side of the map for shading of a tile that only tilts the normal, texels.

    For wide pixels no finer than the tile itself: storm errs as much, open-ocean 2 % more, for 2.5 % of the time.
    """
    return seen_size(quality) if quality.pixel_width == 1 else min(seen_size(quality), displaced_size(quality))


def tile_target(quality: Quality, size: int) -> Target:
    """Return the target of a tile that the surface reads by interpolation."""
    full = quality.sea_digits == "float"
    return Target(
        size=FixedSize.square(size),
        format="RGBA32F" if full else "RGBA16F",
        filter="nearest" if full else "linear",
        wrap="repeat",
    )


def drawn_tiles(scene: Scene, quality: Quality) -> tuple[Cascade, ...]:
    """Return the tiles of the scene's sea that are drawn at a quality: not those without waves.

    At a quarter of the width neither those whose slopes the water's roughness hides (:data:`HIDDEN`).
    """
    if scene.sea is None or scene.sea.wind_speed <= 0.0:
        return ()
    every = cascades(scene.sea, scene.water.depth)[: quality.sea_tiles]
    hidden = HIDDEN * scene.water.roughness if quality.pixel_width > 3 else 0.0
    number = len(every)
    while number > RAISED and summed(tile.mean_square_slope for tile in every[number - 1 :]) <= hidden * hidden:
        number -= 1
    return every[:number]


def _draw(scene: Scene, sea: Sea, quality: Quality) -> Contribution:
    tiles = drawn_tiles(scene, quality)
    if not tiles:
        return Contribution.invisible("no wind, so no waves")
    quality = sea_quality(scene, quality)
    # One Newton step for the march's last ones: 0.82 to 0.86 of the evaluations, and of the error 0.95 (storm) to 1.006
    # (river). Beside gentle seas what else raises the water is met by fewer steps and errs up to 3 % more.
    refined = quality.surface.refine == 0 and (sea.wind_speed >= WHITECAP_WIND or scene.shore is not None)
    raised = tiles[:RAISED]
    max_height = summed(tile.limit for tile in raised)
    contribution = Contribution(
        why=_why(sea, tiles, quality.sea_size),
        slots=_slots(scene, quality, len(tiles)),
        consts={**_consts(sea, tiles, quality), "SEA_READ": READ if quality.samples > 1 else READ_ALONE},
        chosen_consts={"SEA_READ": READ},
        bound=unlit(scene),
        max_height=max_height,
        min_height=-max_height,
        depends=("/water/roughness",) if quality.pixel_width > 3 else (),
        max_slope=summed(tile.max_slope for tile in raised),
        map_error=summed(tile.map_error(quality.sea_size) + tile.limit * effect.HALF_FLOAT for tile in raised),
        march_factor=2,
        refine=1 if refined else 0,
        coarser=2.0 if refined else 1.0,
    )
    return contribution.joined(
        _displaced_water(sea, scene.water.depth, tiles, displaced_size(quality)),
        _orbits(sea, raised, quality) if follows_orbits(scene) else Resources(),
        *(_height_map(scene, i, tile, quality) for i, tile in enumerate(tiles)),
        _mip_maps(tiles, quality),
    )


def _why(sea: Sea, tiles: Sequence[Cascade], size: int) -> str:
    height = 4.0 * math.sqrt(summed(tile.variance for tile in tiles))
    waves = len([wave for tile in tiles for wave in tile.waves])
    how = f"{waves} waves on {len(tiles)} tiles" if sea.model == "gerstner" else f"{len(tiles)} tiles by FFT, {size}²"
    return f"sea of {sea.wind_speed:g} m/s wind, significant height {height:.3g} m: {how}"


def _consts(sea: Sea, tiles: Sequence[Cascade], quality: Quality) -> dict[str, Const]:
    gerstner = sea.model == "gerstner"
    steps = 0 if sea.choppiness == 0.0 else NEWTON if quality.pixel_width == 1 else NEWTON_WIDE
    return {
        "SEA_SIZE": quality.sea_size,
        "SEA_DISPLACED": displaced_size(quality),
        "SEA_SEEN": seen_size(quality),
        "SEA_FINER": math.log2(seen_size(quality) / quality.sea_size),
        "SEA_DETAIL": detail_size(quality),
        "SEA_DETAIL_FINER": math.log2(detail_size(quality) / quality.sea_size),
        "SEA_BAND": BAND,
        "SEA_LOOP": LOOP,
        "SEA_NEWTON": steps,
        "SEA_NEWTON_FOUND": max(steps - 1, 0),
        "SEA_NEWTON_ORBIT": 0 if sea.choppiness == 0.0 else NEWTON,
        "SEA_LEAST_JACOBIAN": LEAST_JACOBIAN,
        "SEA_LEVELS": quality.sea_size.bit_length() - 4,
        "GERSTNER_WAVES": max(len([wave for tile in tiles for wave in tile.waves]), 1) if gerstner else 2,
        "GERSTNER_FIRST": len(tiles[0].waves) if gerstner else 1,
    }


def _fetch(quality: Quality) -> tuple[str, ...]:
    """The files that read a tile bilinearly: filtered by the sampler, or by the shader from full floats."""
    if quality.sea_digits == "float":
        return ("lib/texels.glsl@bilinear", "lib/texels.glsl@cubic_spline", "waves/sea_passes.glsl@fetch_exact")
    return ("lib/texels.glsl@cubic_spline", "waves/sea_passes.glsl@fetch_linear")


def _slots(scene: Scene, quality: Quality, tiles: int) -> tuple[SlotFile, ...]:
    filtered = "waves/sea.glsl@seen" if quality.surface.filter else "waves/sea.glsl@seen_exact"
    needs = (*_fetch(quality), "waves/sea.glsl@level", filtered)
    bounds = SlotFile("bounds", "waves/sea.glsl@bounds", prefix="sea")
    slots = [SlotFile("waves", "waves/sea.glsl@sea", prefix="sea", needs=needs), bounds]
    if scene.shore is None:
        slots.append(SlotFile("short", "waves/sea.glsl@short"))
        slots.append(SlotFile("short bounds", "waves/sea.glsl@short_bounds", needs=("waves/sea.glsl@bounds",)))
    if tiles > RAISED:
        detail = "waves/sea.glsl@detail_two" if tiles == 4 else "waves/sea.glsl@detail_one"
        slots.append(SlotFile("detail", detail, prefix="sea", needs=needs))
    return tuple(slots)


def _displaced_water(sea: Sea, depth: float | None, tiles: Sequence[Cascade], size: int) -> Resources:
    """Displacement of the water at rest positions, a block of ``size``² texels for each tile."""
    water = WaterDrawing(
        DISPLACED,
        "sea_b",
        len(tiles),
        1,
        size,
        by_wave=("waves of the sea", "gerstner", (f"{_PASSES}gerstner_pass",)),
        by_spectrum=("spectrum of the sea", "sea_spectrum", (f"{_PASSES}displaced_pass",)),
        transforms="sea",
        read=size,
    )
    textures = {
        "sea_spectrum": TextureUse(SeaSpectrum(sea=sea, depth=depth), wrap="clamp_to_edge"),
        "fft_twiddles": TextureUse(FftTwiddles(), wrap="clamp_to_edge"),
    }
    return replace(water.resources(sea, tiles), textures={} if sea.model == "gerstner" else textures)


def _height_map(scene: Scene, index: int, tile: Cascade, quality: Quality) -> Resources:
    """Height and slopes of a tile over the level plane, and its measured bounds if it displaces the surface."""
    assert scene.sea is not None
    name = f"sea_tile_{index}"
    size = quality.sea_size if index < RAISED else displaced_size(quality)
    drawn = PassSpec(
        f"sea, {tile.size:g} m tile",
        "sea_tile",
        (*resampled(scene, quality), "waves/sea_passes.glsl@tile_pass"),
        {"u_sea_displaced": DISPLACED},
        {
            "u_sea_block": tile_block(scene.sea, tile, index, quality),
            "u_sea_corner": number(displaced_size(quality) / size),
            "u_sea_limit": vector((significant(tile.limit), significant(tile.max_slope))),
        },
        target=name,
    )
    place = {f"u_sea_offset_{index}": array("vec2", in_tile(tile.size), 1), f"u_sea_size_{index}": number(tile.size)}
    if index >= RAISED:
        return drawn_map(drawn, tile_target(quality, size)).joined(Resources(uniforms=place))
    raised = Resources(uniforms=place, inputs={f"u_sea_bounds_{index}": f"{name}_bounds"})
    bounds = measured_bounds(name, size, tile.size / size)
    return drawn_map(drawn, tile_target(quality, size)).joined(raised, bounds)


def _mip_maps(tiles: Sequence[Cascade], quality: Quality) -> Resources:
    """The tiles' slopes as shading reads them: prefiltered maps, or the tiles themselves if nothing is filtered."""
    if not quality.surface.filter:
        return Resources(inputs={f"u_sea_seen_{i}": f"sea_tile_{i}" for i in range(len(tiles))})
    seen = Resources()
    for i, tile in enumerate(tiles):
        # What only tilts the normal has no more texels than the map of displaced water.
        smooth = _smoothed(quality) or i >= RAISED
        file = "waves/sea.glsl@seen_pass" if smooth else "waves/sea.glsl@seen_same_pass"
        drawn = PassSpec(
            f"sea, {tile.size:g} m tile as seen",
            "sea_seen" if smooth else "sea_seen_same",
            (*_fetch(quality), file),
            {"u_sea_full": f"sea_tile_{i}"},
            target=f"sea_seen_{i}",
        )
        size = FixedSize.square(seen_size(quality) if i < RAISED else detail_size(quality))
        target = Target(size=size, format="RGBA16F", filter=MIPMAPPED, wrap="repeat")
        seen = seen.joined(drawn_map(drawn, target))
    return seen


def _orbits(sea: Sea, raised: Sequence[Cascade], quality: Quality) -> Resources:
    """Horizontal displacement of the water, which carries foam: the tiles on top of each other in one map."""
    side = quality.sea_size // 2
    size = FixedSize(width=side, height=RAISED * (side + 1))
    files, blocks = (*_RESAMPLED, "foam/carry.glsl@sea_orbit"), raised_blocks(sea, raised, quality)
    drawn = PassSpec("orbits of the sea", "sea_orbit", files, {"u_sea_displaced": DISPLACED}, blocks, "sea_orbits")
    target = tile_target(quality, side).model_copy(update={"size": size})
    carry = Resources(slots=(SlotFile("carry", "foam/carry.glsl@sea", prefix="sea"),))
    return drawn_map(drawn, target).joined(carry)


EFFECT = effect.part_effect(
    "sea",
    _draw,
    "/sea",
    QualityParameter("/sea_size", "texels of a sea tile", (64, 128, 256, 512), "geometry"),
    QualityParameter("/sea_tiles", "sea tiles", (2, 3, 4), "geometry"),
    QualityParameter("/sea_digits", "number format of the sea tiles", ("half", "float"), "precision"),
    afloat=tuple(f"u_sea_offset_{index}" for index in range(4)),
)
