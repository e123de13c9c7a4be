"""Wind ripples: slopes from a tile drawn each frame, or summed at each sample. docs/formulae.md, section 2."""

import math
from collections.abc import Sequence

from seafoam.effects.bounds import slope_sensitivity
from seafoam.effects.effect import Bound, Contribution, Effect, Knob, Part, PassSpec, SlotFile, Source
from seafoam.effects.noise import PERLIN_3, drifting_noise
from seafoam.framegraph.resources import FixedSize, Target, TargetInput
from seafoam.framegraph.rules import Constant, Phase, Uniform, array, in_tile, number, rounded, significant
from seafoam.ocean.ripples import BANDS, WAVES_PER_TILE, Ripple, ripples, tiles
from seafoam.quality import Quality
from seafoam.scene.models import Scene
from seafoam.scene.water import Chop

_PER_BAND = WAVES_PER_TILE // BANDS
"""Ripples of a band."""


def ripple_phases(waves: Sequence[Ripple], *, at_camera: bool = False) -> Uniform:
    """Phases of ripples at a tile's origin, or at the camera, rad; float[n]."""
    phases = [
        Phase(offset=wave.phase, rate=wave.omega, k=(-wave.kx, -wave.kz) if at_camera else (0.0, 0.0)) for wave in waves
    ]
    return array("float", phases, len(waves))


def _wave_data(waves: Sequence[Ripple], first_band: int = 0) -> list[Constant]:
    """Wavevector, slope amplitude and band of each ripple of a tile."""
    return [
        Constant(value=(wave.kx, wave.kz, significant(wave.slope), float(first_band + i // _PER_BAND)))
        for i, wave in enumerate(waves)
    ]


def _bands(cascades: tuple[tuple[Ripple, ...], ...]) -> Uniform:
    """Geometric mean of the wavenumbers, rad/m, and mean square slope of each band."""
    bands = [waves[i : i + _PER_BAND] for waves in cascades for i in range(0, WAVES_PER_TILE, _PER_BAND)]
    values = [
        (math.exp(sum(math.log(wave.k) for wave in band) / _PER_BAND), sum(0.5 * wave.slope**2 for wave in band))
        for band in bands
    ]
    return array("vec2", [Constant(value=rounded(value)) for value in values], len(bands))


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Active if the water has wind ripples (``water.chop``)."""
    chop = scene.water.chop
    if chop is None:
        return None
    repeats = scene.light is not None and scene.light.caustics is not None
    cascades, sides = ripples(chop, repeats), tiles(repeats)
    count = WAVES_PER_TILE * len(sides)
    summed = quality.chop == "exact"
    how = "summed at each sample" if summed else f"drawn into {len(sides)} tiles in each frame"
    contribution = Contribution(
        why=f"{count} ripples, {how}",
        consts={"CHOP_WAVES": WAVES_PER_TILE},
        uniforms={"u_chop_band": _bands(cascades)},
        bound=_bound(scene, chop),
    )
    return contribution.joined(
        _slopes("waves/ripples/exact.glsl" if summed else "waves/ripples/tile.glsl", chop),
        _sum(cascades) if summed else _maps(cascades, sides, quality.chop_size),
    )


def _slopes(file: str, chop: Chop) -> Part:
    """The slot file of the slopes, with gusts if the wind has any."""
    gusts = chop.gusts
    if gusts is None or gusts.strength == 0.0:
        return Part(slots=(SlotFile("detail", file, prefix="chop", needs=("waves/ripples/bands.glsl",)),))
    needs = ("waves/ripples/bands.glsl", Source(file, (("chop_detail", "even_detail"),)), *PERLIN_3)
    return Part(
        slots=(SlotFile("detail", "waves/ripples/gusts.glsl", prefix="chop", needs=needs),),
        consts={"GUST_SEED": 64 * gusts.seed},
        uniforms={
            "u_gust_phase": drifting_noise(gusts.size, gusts.speed, chop.wind_direction, gusts.change),
            "u_gust_size": number(gusts.size),
            "u_gust_strength": number(gusts.strength, "/water/chop/gusts/strength"),
        },
    )


def _sum(cascades: tuple[tuple[Ripple, ...], ...]) -> Part:
    """Ripples that are summed at each sample."""
    waves = [wave for cascade in cascades for wave in cascade]
    data = [entry for i, cascade in enumerate(cascades) for entry in _wave_data(cascade, BANDS * i)]
    return Part(
        uniforms={
            "u_chop_wave": array("vec4", data, len(waves)),
            "u_chop_phase": ripple_phases(waves, at_camera=True),
        }
    )


def _maps(cascades: tuple[tuple[Ripple, ...], ...], sides: tuple[float, ...], size: int) -> Part:
    """A map of the slopes of each tile, ``size`` texels along each side."""
    target = Target(size=FixedSize.square(size), format="RGBA16F", filter="linear", wrap="repeat")
    return Part(
        uniforms={
            "u_chop_offset": array("vec2", [rule for side in sides for rule in in_tile(side)], len(sides)),
            "u_chop_size": array("float", [Constant(value=(side,)) for side in sides], len(sides)),
        },
        inputs={f"u_chop_{i}": TargetInput(target=f"chop_{i}") for i in range(len(sides))},
        targets={f"chop_{i}": target for i in range(len(sides))},
        passes=tuple(
            PassSpec(
                name=f"ripples, {side:g} m tile",
                program="chop",
                fragment=("lib/numbers.glsl", "waves/ripples/tile_pass.glsl"),
                target=f"chop_{i}",
                uniforms={
                    "u_chop_wave": array("vec4", _wave_data(waves), len(waves)),
                    "u_chop_phase": ripple_phases(waves),
                    "u_chop_tile": number(side),
                },
            )
            for i, (side, waves) in enumerate(zip(sides, cascades, strict=True))
        ),
    )


def _bound(scene: Scene, chop: Chop) -> Bound | None:
    """Ripples have slopes but no height, so only shading shows them."""
    if scene.light is None:
        return Bound(0.0, "the scene has no light, and ripples show by their shading alone")
    max_slope = sum(wave.slope for cascade in ripples(chop) for wave in cascade)
    fields: tuple[str, ...] = ("/light/exposure", "/water/roughness")
    if chop.gusts is not None:
        max_slope *= 1.0 + chop.gusts.strength
        fields = (*fields, "/water/chop/gusts/strength")
    return Bound(slope_sensitivity(scene) * max_slope, f"the greatest slope is {max_slope:.1g}", fields)


EFFECT = Effect(
    "ripples",
    contribute,
    fields=("/water/chop", "/water/chop/gusts"),
    knobs=(
        Knob("/chop", "ripples", ("tile", "exact"), "geometry"),
        Knob("/chop_size", "texels of the ripple tile", (64, 128, 256, 512), "geometry"),
    ),
)
