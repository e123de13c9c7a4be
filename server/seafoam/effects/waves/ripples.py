"""Wind ripples: slopes from a tile drawn each frame, or summed at each sample. docs/formulae.md, section 2."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

from seafoam.effects.bounds import slope_sensitivity
from seafoam.effects.effect import Bound, Const, Contribution, Effect, Knob, PassSpec, SlotFile, Source
from seafoam.effects.noise import PERLIN_3, drifting_noise
from seafoam.framegraph.resources import FixedSize, Target, TargetInput
from seafoam.framegraph.rules import Constant, Phase, Uniform, Wrap, array, number, significant
from seafoam.ocean.ripples import BANDS, WAVES_PER_TILE, Ripple, ripples, tiles
from seafoam.quality import Quality
from seafoam.scene.models import Scene
from seafoam.scene.water import Chop


def _data(waves: Sequence[Ripple], first_band: int = 0) -> list[Constant]:
    per_band = WAVES_PER_TILE // BANDS
    return [
        Constant(value=(wave.kx, wave.kz, significant(wave.slope), float(first_band + i // per_band)))
        for i, wave in enumerate(waves)
    ]


def _bands(cascades: tuple[tuple[Ripple, ...], ...]) -> Uniform:
    per_band = WAVES_PER_TILE // BANDS
    bands = [waves[i : i + per_band] for waves in cascades for i in range(0, WAVES_PER_TILE, per_band)]
    return array(
        "vec2",
        [
            Constant(
                value=(
                    significant(math.exp(sum(math.log(wave.k) for wave in band) / per_band)),
                    significant(sum(0.5 * wave.slope**2 for wave in band)),
                )
            )
            for band in bands
        ],
        len(bands),
    )


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by ``water.chop``."""
    chop = scene.water.chop
    if chop is None:
        return None
    bound = _bound(scene, chop)
    gusts = _gusts(chop)
    repeats = scene.light is not None and scene.light.caustics is not None
    sides = tiles(repeats)
    cascades = ripples(chop, repeats)
    consts: dict[str, Const] = {"CHOP_WAVES": WAVES_PER_TILE}
    uniforms = {"u_chop_band": _bands(cascades)}
    if quality.chop == "exact":
        waves = [wave for cascade in cascades for wave in cascade]
        data = [entry for i, cascade in enumerate(cascades) for entry in _data(cascade, BANDS * i)]
        phases = [Phase(offset=wave.phase, rate=wave.omega, k=(-wave.kx, -wave.kz)) for wave in waves]
        return Contribution(
            why=f"{len(waves)} ripples, summed at each sample",
            slots=(_detail("waves/ripples/exact.glsl", gusts),),
            consts={**consts, **gusts.consts},
            uniforms={
                **uniforms,
                **gusts.uniforms,
                "u_chop_wave": array("vec4", data, len(waves)),
                "u_chop_phase": array("float", phases, len(waves)),
            },
            bound=bound,
        )
    offsets = [Wrap(k=k) for tile in sides for k in ((1.0 / tile, 0.0), (0.0, 1.0 / tile))]
    return Contribution(
        why=f"{WAVES_PER_TILE * len(sides)} ripples, drawn into {len(sides)} tiles each frame",
        slots=(_detail("waves/ripples/tile.glsl", gusts),),
        consts={**consts, **gusts.consts},
        uniforms={
            **uniforms,
            **gusts.uniforms,
            "u_chop_offset": array("vec2", offsets, len(sides)),
            "u_chop_size": array("float", [Constant(value=(tile,)) for tile in sides], len(sides)),
        },
        inputs={f"u_chop_{i}": TargetInput(target=f"chop_{i}") for i in range(len(sides))},
        targets={
            f"chop_{i}": Target(
                size=FixedSize(width=quality.chop_size, height=quality.chop_size),
                format="RGBA16F",
                filter="linear",
                wrap="repeat",
            )
            for i in range(len(sides))
        },
        passes=tuple(
            PassSpec(
                name=f"ripples, {tile:g} m tile",
                program="chop",
                fragment=("lib/numbers.glsl", "waves/ripples/tile_pass.glsl"),
                target=f"chop_{i}",
                uniforms={
                    "u_chop_wave": array("vec4", _data(waves), len(waves)),
                    "u_chop_phase": array(
                        "float", [Phase(offset=wave.phase, rate=wave.omega, k=(0.0, 0.0)) for wave in waves], len(waves)
                    ),
                    "u_chop_tile": number(tile),
                },
            )
            for i, (tile, waves) in enumerate(zip(sides, cascades, strict=True))
        ),
        bound=bound,
    )


@dataclass(frozen=True)
class _Gusts:
    """What gusts add to the ripples' contribution."""

    consts: dict[str, Const] = field(default_factory=dict)
    uniforms: dict[str, Uniform] = field(default_factory=dict)


def _gusts(chop: Chop) -> _Gusts:
    gusts = chop.gusts
    if gusts is None or gusts.strength == 0.0:
        return _Gusts()
    return _Gusts(
        {"GUST_SEED": 64 * gusts.seed},
        {
            "u_gust_phase": drifting_noise(gusts.size, gusts.speed, chop.wind_direction, gusts.change),
            "u_gust_size": number(gusts.size),
            "u_gust_strength": number(gusts.strength, "/water/chop/gusts/strength"),
        },
    )


def _detail(ripples_file: str, gusts: _Gusts) -> SlotFile:
    if not gusts.uniforms:
        return SlotFile("detail", ripples_file, prefix="chop", needs=("waves/ripples/bands.glsl",))
    needs = ("waves/ripples/bands.glsl", Source(ripples_file, (("chop_detail", "even_detail"),)), *PERLIN_3)
    return SlotFile("detail", "waves/ripples/gusts.glsl", prefix="chop", needs=needs)


def _bound(scene: Scene, chop: Chop) -> Bound | None:
    """Ripples show by their slopes alone, and only under a light."""
    if scene.light is None:
        return Bound(0.0, "there is no light, and ripples show by their shading alone")
    most = sum(wave.slope for cascade in ripples(chop) for wave in cascade)
    fields: tuple[str, ...] = ("/light/exposure", "/water/roughness")
    if chop.gusts is not None:
        most *= 1.0 + chop.gusts.strength
        fields = (*fields, "/water/chop/gusts/strength")
    return Bound(slope_sensitivity(scene) * most, f"slopes are never above {most:.1g}", fields)


EFFECT = Effect(
    "ripples",
    contribute,
    knobs=(
        Knob("/chop", "ripples", ("tile", "exact"), "geometry"),
        Knob("/chop_size", "texels of the ripple tile", (64, 128, 256, 512), "geometry"),
    ),
)
