"""Foam where the open sea folds, and for seconds after. docs/formulae.md, section 4."""

import math

from seafoam.effects.effect import Bound, Contribution, Effect, Knob, PassSpec, SlotFile, Source
from seafoam.effects.waves.sea import (
    displaced_target,
    drawn,
    fitted,
    gerstner_uniforms,
    loop_uniforms,
    tile_target,
    tile_uniforms,
    transform,
)
from seafoam.framegraph.resources import MIPMAPPED, FixedSize, Target, TargetInput, TextureInput
from seafoam.framegraph.rules import Constant, Uniform, array, number, significant, vector
from seafoam.ocean.cascades import RAISED, Cascade
from seafoam.ocean.stokes import foam_drift
from seafoam.ocean.whitecaps import OLD_STEP, OLD_STEPS, OLD_TEXELS, WhitecapModel, old_times, whitecap_model
from seafoam.quality import Quality
from seafoam.scene.foam import FoldSaturation, SlopeSaturation
from seafoam.scene.models import Scene
from seafoam.scene.waves import Sea


def contribute(scene: Scene, quality: Quality) -> Contribution | None:
    """Called for by a saturation with source ``fold``."""
    if scene.foam is None:
        return None
    found = [source for source in scene.foam.saturation if isinstance(source, FoldSaturation)]
    if not found:
        return None
    raised = drawn(scene, quality)[:RAISED]
    if scene.sea is None or not raised:
        return Contribution(why="", bound=Bound(0.0, "no sea that could fold"))
    quality = fitted(scene.sea, quality)
    steps = quality.age_steps
    model = whitecap_model(scene.sea, found[0], scene.water.depth, steps, quality.age_step, quality.sea_size)
    if model is None:
        return Contribution(why="", bound=Bound(0.0, "a sea that nothing folds, or no foam asked for"))
    slopes = sum(of.mean_square_slope for of in raised)
    limits = [Constant(value=tuple(significant(part) for part in pair)) for pair in (model.now, model.earlier)]
    uniforms: dict[str, Uniform] = {
        "u_fold": array("vec2", limits, 2),
        "u_fold_variance": vector((*(significant(part / slopes) for part in model.variance), significant(slopes))),
        "u_fold_clamped": number(significant(model.clamped)),
        "u_fold_share": array("float", [Constant(value=(significant(s),)) for s in model.shares], steps + 1),
    }
    # Foam by slope shades other places before this is asked.
    shared = not any(isinstance(source, SlopeSaturation) for source in scene.foam.saturation)
    name = str(steps) if steps else "now"
    why = f"foam where the Jacobian is below {1.0 + model.now[0]:.2f}"
    lasts = bool(model.old_shares)
    needs = (
        "foam/saturation/fold.glsl",
        *((f"foam/saturation/fold_{'old' if lasts else 'no_old'}.glsl",) if steps else ()),
    )
    slots = (SlotFile("saturation", f"foam/saturation/fold_{name}.glsl", prefix="fold", needs=needs),)
    if not steps:
        return Contribution(why=why, slots=slots, consts={"FOLD_TIMES": 1, "FOLD_SHARED": shared}, uniforms=uniforms)
    targets, passes = _ages(scene, scene.sea, raised, quality)
    inputs: dict[str, TextureInput | TargetInput] = {"u_age_tiles": TargetInput(target="age_tiles")}
    last = steps * quality.age_step
    if lasts:
        old_targets, old_passes = _old(scene, scene.sea, raised[0], quality, model)
        targets |= old_targets
        passes += old_passes
        inputs["u_old_foam"] = TargetInput(target="old_foam")
        last = old_times(steps, quality.age_step)[-1]
    return Contribution(
        why=f"{why}, and was in the last {last:g} s",
        slots=slots,
        consts={
            "FOLD_TIMES": steps + 1,
            "FOLD_SHARED": shared,
            "AGE_SIZE": quality.sea_size // 2,
            "AGE_ROWS": steps // 4,
            "OLD_SIZE": OLD_TEXELS,
            "AGE_DRIFTS": foam_drift(scene) != (0.0, 0.0),
        },
        uniforms=uniforms,
        inputs=inputs,
        targets=targets,
        passes=passes,
    )


def _ages(
    scene: Scene, sea: Sea, raised: tuple[Cascade, ...], quality: Quality
) -> tuple[dict[str, Target], tuple[PassSpec, ...]]:
    """Targets and passes that draw the folds of earlier times."""
    size, rows = quality.sea_size // 2, quality.age_steps // 4
    plain = Target(size=FixedSize(width=size * len(raised), height=size * rows), format="RGBA32F")
    uniforms = _times(scene, sea, raised, 0.0, quality.age_step)
    targets = {"age_a": plain}
    passes: tuple[PassSpec, ...]
    if sea.model == "gerstner":
        folds = "age_a"
        passes = (
            PassSpec(
                name="folds of earlier waves",
                program="age_gerstner",
                fragment=("lib/numbers.glsl", "waves/sea/gerstner.glsl", "waves/sea/age_gerstner_pass.glsl"),
                target="age_a",
                uniforms={**gerstner_uniforms(raised, 0), **uniforms},
            ),
        )
    else:
        targets["age_b"] = plain
        first = PassSpec(
            name="spectrum of earlier folds",
            program="age_spectrum",
            fragment=("lib/numbers.glsl", "waves/sea/spectrum.glsl", "waves/sea/age_spectrum_pass.glsl"),
            target="age_a",
            inputs={"u_sea_spectrum": TextureInput(texture="sea_spectrum")},
            uniforms={**loop_uniforms(), **uniforms},
        )
        others, folds = transform("earlier times of folds", "age_a", "age_b", size)
        passes = (first, *others)
    displaced = displaced_target(scene, quality)
    over = FixedSize(width=size, height=(size + 1) * rows * RAISED)
    targets["age_tiles"] = tile_target(quality, size).model_copy(update={"size": over})
    passes += tuple(
        PassSpec(
            name=f"earlier folds, {of.size:g} m tile",
            program="age_tile",
            fragment=("waves/sea/resample_pass.glsl", "waves/sea/age_tile_pass.glsl"),
            target="age_tiles",
            inputs={
                "u_sea_displaced": TargetInput(target=displaced),
                "u_age_folds": TargetInput(target=folds),
            },
            uniforms=tile_uniforms(of, i, sea.choppiness, quality.sea_size),
        )
        for i, of in enumerate(raised)
    )
    return targets, passes


def _old(
    scene: Scene, sea: Sea, largest: Cascade, quality: Quality, model: WhitecapModel
) -> tuple[dict[str, Target], tuple[PassSpec, ...]]:
    """Targets and passes that draw what foam of long ago is left."""
    rows = OLD_STEPS // 4
    plain = Target(size=FixedSize(width=OLD_TEXELS, height=OLD_TEXELS * rows), format="RGBA32F")
    uniforms = _times(scene, sea, (largest,), quality.age_steps * quality.age_step, OLD_STEP)
    targets = {"old_a": plain}
    passes: tuple[PassSpec, ...]
    if sea.model == "gerstner":
        folds = "old_a"
        passes = (
            PassSpec(
                name="folds of long ago",
                program="old_gerstner",
                fragment=(
                    "lib/numbers.glsl",
                    "waves/sea/gerstner.glsl",
                    Source("waves/sea/age_gerstner_pass.glsl", (("AGE_SIZE", "OLD_SIZE"),)),
                ),
                target="old_a",
                uniforms={**gerstner_uniforms(drawn(scene, quality)[:RAISED], 0), **uniforms},
            ),
        )
    else:
        targets["old_b"] = plain
        first = PassSpec(
            name="spectrum of folds of long ago",
            program="old_spectrum",
            fragment=(
                "lib/numbers.glsl",
                "waves/sea/spectrum.glsl",
                Source("waves/sea/age_spectrum_pass.glsl", (("AGE_SIZE", "OLD_SIZE"),)),
            ),
            target="old_a",
            inputs={"u_sea_spectrum": TextureInput(texture="sea_spectrum")},
            uniforms={**loop_uniforms(), **uniforms},
        )
        others, folds = transform("folds of long ago", "old_a", "old_b", OLD_TEXELS)
        passes = (first, *others)
    size = quality.sea_size // 2
    targets["old_foam"] = Target(
        size=FixedSize(width=size, height=size), format="RGBA16F", filter=MIPMAPPED, wrap="repeat"
    )
    shares = model.old_shares
    passes += (
        PassSpec(
            name="foam of long ago",
            program="old_foam",
            fragment=("waves/sea/resample_pass.glsl", "waves/sea/old_foam_pass.glsl"),
            target="old_foam",
            inputs={
                "u_sea_displaced": TargetInput(target=displaced_target(scene, quality)),
                "u_old_folds": TargetInput(target=folds),
            },
            uniforms={
                **tile_uniforms(largest, 0, sea.choppiness, quality.sea_size),
                "u_old_fold": vector((significant(model.old[0]), significant(model.old[1]))),
                "u_old_share": array(
                    "vec4",
                    [
                        Constant(value=tuple(significant(share) for share in shares[i : i + 4]))
                        for i in range(0, len(shares), 4)
                    ],
                    rows,
                ),
            },
        ),
    )
    return targets, passes


def _times(scene: Scene, sea: Sea, tiles: tuple[Cascade, ...], before: float, step: float) -> dict[str, Uniform]:
    """What passes that draw folds of other times are told: when, and how the water has drifted since."""
    scales = [of.choppiness(sea.choppiness) * 2.0 * math.pi / of.size for of in tiles]
    drift = foam_drift(scene)
    turns = [significant(2.0 * math.pi / of.size * part) for of in (tiles[0], tiles[-1]) for part in drift]
    return {
        "u_age_scale": vector((significant(scales[0]), significant(scales[-1]))),
        "u_age_step": number(step),
        "u_age_from": number(significant(before)),
        "u_age_drift": vector(tuple(turns)),
    }


EFFECT = Effect(
    "fold foam",
    contribute,
    knobs=(
        Knob("/age_steps", "earlier times of folds", (0, 4, 8), "geometry"),
        Knob("/age_step", "interval between folds, s", (0.17, 0.35, 0.7), "geometry"),
    ),
)
