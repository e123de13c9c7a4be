"""Server frames against the float64 truth in ``tests/references``."""

import numpy as np
import pytest

from references import bake
from seafoam.quality import TIERS
from seafoam.reference import render
from seafoam.render.gl.executor import Executor
from support.exact import UNFILTERED
from support.parity import HARD, mean_of, parity
from support.pictures import linear, rms, rmse, samples
from support.report import Report
from support.scenes import load_preset, preset_names
from support.sweep import crossed, spread


def test_truth_is_of_the_scenes_that_are_judged() -> None:
    """A preset that changed without a new bake would be judged by the wrong picture."""
    jobs = [job for name in preset_names() for job in bake.jobs_of(name)]
    stale = [job.name for job in jobs if not bake.truth_is_current(job.name, job.scene)]
    assert not stale, f"run make bake: {stale}"
    assert {path.stem for path in bake.DIRECTORY.glob("*.npz")} == {job.name for job in jobs}


@pytest.mark.parametrize(("preset", "time"), crossed(preset_names(), bake.TIMES, len(bake.TIMES), 3, 1))
def test_reference_quality_is_the_truth(executor: Executor, report: Report, preset: str, time: float) -> None:
    found = parity(executor, preset, time)
    report.add(
        "Frames against the float64 truth (RMSE in 8-bit levels of linear light)",
        preset=preset,
        size=f"{found.size[0]} × {found.size[1]}",
        time=f"{time:g} s",
        below_1_degree=f"{found.near:.3f}",
        whole=f"{found.whole:.3f}",
        flipped=f"{100 * found.flipped:.3f} %",
        tone=f"{100 * found.tone:.4f} %",
    )
    assert not found.exceeded()


@pytest.mark.parametrize("preset", ["default", "boat-race", "spray-on-rocks", "paper-halftone"])
def test_the_frame_is_the_mean_of_its_samples(executor: Executor, preset: str) -> None:
    """With passes over the picture and without."""
    scene, size = load_preset(preset).scene, (96, 54)
    every, mean = (of(executor, scene, UNFILTERED, time=2.7, size=size) for of in (samples, linear))
    assert every.shape[1] > size[0]
    want = mean_of(every, size)
    # A sum of float32 in another order.
    assert np.abs(mean - want).max() <= 1e-5 * (1.0 + np.abs(want).max())


@pytest.mark.parametrize("preset", bake.EVERY_LOOK)
def test_filtered_has_less_error_than_any_hard_look(executor: Executor, report: Report, preset: str) -> None:
    """One sample a pixel, each look against its own limit of infinitely many."""
    scene = load_preset(preset).scene
    errors = {}
    for look in (*HARD, "filtered", "textured"):
        variant = scene.model_copy(update={"foam": scene.foam.model_copy(update={"look": look})})
        truth = bake.load_truth(f"{preset}.converged.{look}")
        drawn = linear(executor, variant, TIERS["standard"], time=bake.CONVERGED_TIME, size=bake.CONVERGED_SIZE)
        errors[look] = rmse(drawn, truth.rgb)
        report.add(
            "One sample a pixel against 256, standard quality, 160 × 90",
            preset=preset,
            look=look,
            picture=f"{errors[look]:.2f}",
            coverage=f"{rms(drawn[..., 3] - truth.alpha):.4f}",
        )
    # Foam that lives does so in this look alone: carried and of its age it has more to miss.
    assert errors["filtered"] < (1.1 if scene.foam.life is not None else 1.0) * min(errors[look] for look in HARD)


# Of the default preset the truth is computed here, for a minute.
@pytest.mark.parametrize("preset", spread(bake.EVERY_LOOK, 2, 1))
def test_filtered_once_is_halftone_sixteen_times_over_waves(executor: Executor, report: Report, preset: str) -> None:
    """Of one octave, the only one that halftone has, and small enough that far pixels hold many texels."""
    scene = load_preset(preset).scene
    small = {"mask": "mix", "mask_tile": 5.0, "octaves": 1} if scene.foam.octaves > 1 else {}
    errors = {}
    for look, count in (("halftone", 16), ("filtered", 1)):
        variant = scene.model_copy(update={"foam": scene.foam.model_copy(update={"look": look, **small})})
        if small:
            width, height = bake.CONVERGED_SIZE
            truth = render(variant, time=bake.CONVERGED_TIME, width=width, height=height, samples=6, mode="converged")
        else:
            truth = bake.load_truth(f"{preset}.converged.{look}")
        quality = TIERS["standard"].model_copy(update={"samples": count})
        drawn = linear(executor, variant, quality, time=bake.CONVERGED_TIME, size=bake.CONVERGED_SIZE)
        errors[f"{look}_coverage"] = rms(drawn[..., 3] - truth.alpha)
        errors[f"{look}_picture"] = rmse(drawn, truth.rgb)
    report.add(
        "Filtered once against halftone sixteen times, each look against its own limit, 160 × 90",
        preset=preset,
        **{name: f"{error:.4f}" for name, error in errors.items()},
    )
    assert errors["filtered_coverage"] <= errors["halftone_coverage"]
