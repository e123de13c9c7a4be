"""Wind ripples: slopes from a tile drawn each frame, or summed at each sample. docs/formulae.md, section 2."""

import math
from collections.abc import Sequence

from seafoam.effects.effect import Bound, Contribution, PassSpec, QualityParameter, Resources, drawn_map, part_effect
from seafoam.effects.shader import PERLIN_3, SlotFile, Source, drifting_noise
from seafoam.framegraph.resources import FixedSize, Target
from seafoam.framegraph.rules import Phase, Uniform, Wrap, array, constants, in_tile, number, rounded, significant
from seafoam.ocean.waves.ripples import BANDS, SHIFTS, TURN, WAVES_PER_TILE, Ripple, ripple_cascades, tiles
from seafoam.quality import Quality
from seafoam.scene import Ripples, Scene, Water
from seafoam.sums import summed

_PER_BAND = WAVES_PER_TILE // BANDS
"""Ripples of a band."""
_TILES = 2


def ripple_phases(waves: Sequence[Ripple], *, at_camera: bool = False) -> Uniform:
    """Phases of ripples at a tile's origin, or at the camera, rad; float[n]."""
    phases = [
        Phase(offset=wave.phase, rate=wave.omega, k=(-wave.kx, -wave.kz) if at_camera else (0.0, 0.0)) for wave in waves
    ]
    return array("float", phases, len(waves))


def _wave_data(waves: Sequence[Ripple], first_band: int = 0) -> list[tuple[float, ...]]:
    """Wavevector, slope amplitude and band of each ripple of a tile."""
    return [(of.kx, of.kz, significant(of.slope), float(first_band + i // _PER_BAND)) for i, of in enumerate(waves)]


def _bands(cascades: tuple[tuple[Ripple, ...], ...]) -> Uniform:
    """Geometric mean of the wavenumbers, rad/m, and mean square slope of each band, with that of its copy."""
    copies = len(cascades) // _TILES
    bands = [waves[i : i + _PER_BAND] for waves in cascades[:_TILES] for i in range(0, WAVES_PER_TILE, _PER_BAND)]
    values = [
        (
            math.exp(summed(math.log(wave.k) for wave in band) / _PER_BAND),
            copies * summed(0.5 * wave.slope**2 for wave in band),
        )
        for band in bands
    ]
    return constants("vec2", map(rounded, values))


def _draw(scene: Scene, water: Water, ripples: Ripples, quality: Quality) -> Contribution:
    repeats = scene.light is not None and scene.light.caustics is not None
    cascades, sides = ripple_cascades(ripples, repeats), tiles(repeats)
    count, copies = WAVES_PER_TILE * len(cascades), len(cascades) // _TILES
    summed = quality.ripples == "exact"
    twice = ", read twice" if copies == 2 else ""
    how = "summed at each sample" if summed else f"drawn into {len(sides)} tiles in each frame{twice}"
    contribution = Contribution(
        why=f"{count} ripples, {how}",
        consts={"RIPPLE_WAVES": WAVES_PER_TILE, "RIPPLE_COPIES": copies},
        uniforms={"u_ripples_band": _bands(cascades)},
        # Ripples have slopes but no height.
        bound=Bound.zero_if(scene.light is None, "the scene has no light, and ripples show by their shading alone")
        or Bound.zero_if(ripples.slope == 0.0, "the ripples have no slope"),
    )
    if not summed:
        return contribution.joined(
            _slopes("waves/ripples.glsl@tile", ripples), _maps(cascades, sides, quality.ripples_size)
        )
    waves = [wave for cascade in cascades for wave in cascade]
    data = [entry for i, cascade in enumerate(cascades) for entry in _wave_data(cascade, BANDS * (i % _TILES))]
    phases = ripple_phases(waves, at_camera=True)
    own = Resources(uniforms={"u_ripples_wave": constants("vec4", data), "u_ripples_phase": phases})
    return contribution.joined(_slopes("waves/ripples.glsl@exact", ripples), own)


def _slopes(file: str, ripples: Ripples) -> Resources:
    gusts = ripples.gusts
    if gusts is None or gusts.strength == 0.0:
        return Resources(slots=(SlotFile("detail", file, prefix="ripples", needs=("waves/ripples.glsl@bands",)),))
    needs = ("waves/ripples.glsl@bands", Source(file, (("ripples_detail", "even_detail"),)), *PERLIN_3)
    return Resources(
        slots=(SlotFile("detail", "waves/ripples.glsl@gusts", prefix="ripples", needs=needs),),
        consts={"GUST_SEED": 64 * gusts.seed},
        uniforms={
            "u_gust_phase": drifting_noise(gusts.size, gusts.wind_speed, ripples.downwind, gusts.change),
            "u_gust_size": number(gusts.size),
            "u_gust_strength": number(gusts.strength, "/water/ripples/gusts/strength"),
        },
    )


def _maps(cascades: tuple[tuple[Ripple, ...], ...], sides: tuple[float, ...], size: int) -> Resources:
    """A map of the slopes of each tile, ``size`` texels along each side."""
    target = Target(size=FixedSize.square(size), format="RGBA16F", filter="linear", wrap="repeat")
    places = [rule for side in sides for rule in in_tile(side)]
    if len(cascades) == 2 * _TILES:
        for side, shift in zip(sides, SHIFTS, strict=True):
            # The camera's place in the turned copy of a tile, in sides.
            x, z = TURN[0] / side, TURN[1] / side
            places += [Wrap(k=(x, z), offset=shift[0]), Wrap(k=(-z, x), offset=shift[1])]
    offsets = array("vec2", places, len(cascades))
    maps = Resources(uniforms={"u_ripples_offset": offsets, "u_ripples_size": constants("float", sides)})
    for i, (side, waves) in enumerate(zip(sides, cascades, strict=False)):
        uniforms = {
            "u_ripples_wave": constants("vec4", _wave_data(waves)),
            "u_ripples_phase": ripple_phases(waves),
            "u_ripples_tile": number(side),
        }
        files = ("lib/numbers.glsl", "waves/ripples.glsl@tile_pass")
        drawn = PassSpec(f"ripples, {side:g} m tile", "ripples", files, {}, uniforms, target=f"ripples_{i}")
        maps = maps.joined(drawn_map(drawn, target))
    return maps


EFFECT = part_effect(
    "ripples",
    _draw,
    "/water/ripples",
    QualityParameter("/ripples", "ripples", ("tile", "exact"), "geometry"),
    QualityParameter("/ripples_size", "texels of the ripple tile", (64, 128, 256, 512), "geometry"),
    fields=("/water/ripples/gusts",),
    afloat=("u_ripples_offset", "u_ripples_phase"),
)
