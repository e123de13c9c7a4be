"""Whitecaps: foam where the open sea's Jacobian is small, and for seconds after. docs/formulae.md, section 4."""

import math
from dataclasses import replace

from seafoam.effects import effect
from seafoam.effects.effect import Contribution, PassSpec, QualityParameter, Resources, drawn_map
from seafoam.effects.shader import SlotFile
from seafoam.effects.waves import sea as waves
from seafoam.framegraph.resources import MIPMAPPED, FixedSize, Target
from seafoam.framegraph.rules import Uniform, constants, number, rounded, significant, vector
from seafoam.ocean.foam.whitecaps import OLD_STEP, OLD_STEPS, OLD_TEXELS, WhitecapModel, old_times, whitecap_model
from seafoam.ocean.waves.cascades import RAISED, Cascade
from seafoam.ocean.waves.stokes import foam_drift
from seafoam.quality import Quality
from seafoam.scene import Foam, Scene, Sea, SlopeSaturation, WhitecapSaturation
from seafoam.sums import summed

_TIMES_BEFORE = "waves/age.glsl@times"
_TIMES = {
    0: "foam/saturation/whitecap.glsl@now",
    4: "foam/saturation/whitecap.glsl@four",
    8: "foam/saturation/whitecap.glsl@eight",
}
"""Files of the foam, by how many earlier times are read."""


def draw(scene: Scene, foam: Foam, source: WhitecapSaturation, quality: Quality) -> Contribution:
    raised = waves.drawn_tiles(scene, quality)[:RAISED]
    if scene.sea is None or not raised:
        return Contribution.invisible("no sea whose waves could break")
    quality = waves.sea_quality(scene, quality)
    steps = quality.age_steps
    smooth = waves.seen_size(quality) > quality.sea_size
    model = whitecap_model(scene.sea, source, scene.water.depth, steps, quality.age_step, quality.sea_size, smooth)
    if model is None:
        return Contribution.invisible("a sea whose waves do not break, or a coverage of 0")
    needs: tuple[str, ...] = ("foam/saturation/whitecap.glsl@whitecap",)
    if steps > 0:
        needs += ("foam/saturation/whitecap.glsl@old" if model.old_shares else "foam/saturation/whitecap.glsl@no_old",)
    slopes = summed(tile.mean_square_slope for tile in raised)
    present = Contribution(
        why=f"foam where the Jacobian is below {1.0 + model.now[0]:.2f}",
        slots=(SlotFile("saturation", _TIMES[steps], prefix="whitecap", needs=needs),),
        consts={
            "FOLD_TIMES": steps + 1,
            # The Jacobian of the sample just shaded is reused, unless foam by slope shades other places first.
            "FOLD_SHARED": foam.source(SlopeSaturation) is None,
            "AGE_SIZE": quality.sea_size // 2,
            "AGE_ROWS": steps // 4,
            "OLD_SIZE": OLD_TEXELS,
            "AGE_DRIFTS": foam_drift(scene) != (0.0, 0.0),
        },
        uniforms={
            "u_whitecap": constants("vec2", map(rounded, (model.now, model.earlier))),
            "u_whitecap_variance": vector(rounded((*(part / slopes for part in model.variance), slopes))),
            "u_whitecap_clamped": number(significant(model.clamped)),
            "u_whitecap_share": constants("float", map(significant, model.shares)),
        },
    )
    if steps == 0:
        return present
    # Recent times of all tiles and, if foam lasts, old ones of the largest.
    earlier, earliest = [_recent(scene, scene.sea, raised, quality)], steps * quality.age_step
    if model.old_shares:
        earlier.append(_old(scene, scene.sea, raised, quality, model))
        earliest = old_times(steps, quality.age_step)[-1]
    return replace(present, why=f"{present.why}, and was in the last {earliest:g} s").joined(*earlier)


def _recent(scene: Scene, sea: Sea, raised: tuple[Cascade, ...], quality: Quality) -> Resources:
    """What draws the Jacobians of recent times, and carries them to where the water is now."""
    size, rows = quality.sea_size // 2, quality.age_steps // 4
    jacobians = waves.WaterDrawing(
        "age_a",
        "age_b",
        len(raised),
        rows,
        size,
        by_wave=("folds of earlier waves", "age_gerstner", (_TIMES_BEFORE, "waves/age.glsl@gerstner_pass")),
        by_spectrum=("spectrum of earlier folds", "age_spectrum", (_TIMES_BEFORE, "waves/age.glsl@spectrum_pass")),
        transforms="earlier times of folds",
        uniforms=_time_uniforms(scene, sea, raised, 0.0, quality.age_step),
        format=waves.tile_target(quality, size).format,
    )
    over = FixedSize(width=size, height=(size + 1) * rows * RAISED)
    carried = PassSpec(
        "earlier folds",
        "age_tile",
        (*waves.resampled(scene, quality), "waves/age.glsl@tile_pass"),
        {"u_sea_displaced": waves.DISPLACED, "u_age_folds": jacobians.target},
        waves.raised_blocks(sea, raised, quality),
        target="age_tiles",
    )
    target = waves.tile_target(quality, size).model_copy(update={"size": over})
    return jacobians.resources(sea, raised).joined(drawn_map(carried, target))


def _old(scene: Scene, sea: Sea, raised: tuple[Cascade, ...], quality: Quality, model: WhitecapModel) -> Resources:
    """What draws the old foam that is left, from Jacobians of the largest tile."""
    rows, largest = OLD_STEPS // 4, raised[0]
    jacobians = waves.WaterDrawing(
        "old_a",
        "old_b",
        1,
        rows,
        OLD_TEXELS,
        by_wave=("folds of long ago", "old_gerstner", (_TIMES_BEFORE, "waves/age.glsl@gerstner_pass")),
        by_spectrum=("spectrum of folds of long ago", "old_spectrum", (_TIMES_BEFORE, "waves/age.glsl@spectrum_pass")),
        transforms="folds of long ago",
        uniforms=_time_uniforms(scene, sea, (largest,), quality.age_steps * quality.age_step, OLD_STEP),
        format=waves.tile_target(quality, OLD_TEXELS).format,
    )
    shares = rounded(model.old_shares)
    foam = PassSpec(
        "foam of long ago",
        "old_foam",
        (*waves.resampled(scene, quality), "waves/age.glsl@old_foam_pass"),
        read={"u_sea_displaced": waves.DISPLACED, "u_old_folds": jacobians.target},
        uniforms={
            "u_sea_block": waves.tile_block(sea, largest, 0, quality),
            "u_old_fold": vector(rounded(model.old)),
            "u_old_share": constants("vec4", (shares[i : i + 4] for i in range(0, len(shares), 4))),
        },
    )
    side = FixedSize.square(quality.sea_size // 2)
    target = Target(size=side, format="RGBA16F", filter=MIPMAPPED, wrap="repeat")
    return jacobians.resources(sea, raised).joined(drawn_map(foam, target))


def _time_uniforms(
    scene: Scene, sea: Sea, tiles: tuple[Cascade, ...], before: float, step: float
) -> dict[str, Uniform]:
    """Times of a series, ``step`` s apart, the first ``step`` s before an age of ``before`` s; and the drift since."""
    scales = [tile.choppiness(sea.choppiness) * 2.0 * math.pi / tile.size for tile in tiles]
    drift = foam_drift(scene)
    turns = [significant(2.0 * math.pi / tile.size * part) for tile in (tiles[0], tiles[-1]) for part in drift]
    return {
        "u_age_scale": vector(rounded((scales[0], scales[-1]))),
        "u_age_step": number(step),
        "u_age_from": number(significant(before)),
        "u_age_drift": vector(tuple(turns)),
    }


def fold_limit(source: WhitecapSaturation, scene: Scene) -> float:
    return 1.0 if scene.sea is not None and scene.sea.wind_speed > 0.0 else 0.0


EFFECT = effect.foam_effect(
    "whitecaps",
    draw,
    effect.SaturationSource(WhitecapSaturation, fold_limit),
    QualityParameter("/age_steps", "earlier times of folds", (0, 4, 8), "geometry"),
    QualityParameter("/age_step", "interval between folds, s", (0.17, 0.35, 0.7), "geometry"),
)
