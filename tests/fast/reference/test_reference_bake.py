"""Which frames are baked, and baking one."""

from dataclasses import replace
from pathlib import Path
from typing import get_args

from seafoam.reference import load_truth, truth_is_current
from seafoam.reference.bake import EVERY_LOOK, TIMES, baked, jobs_of, truth_file
from seafoam.scene.foam import Look
from seafoam.scene.presets import load_preset, preset_names


def test_every_preset_has_its_frames() -> None:
    jobs = [job for name in preset_names() for job in jobs_of(name, load_preset(name).scene)]
    assert len({job.name for job in jobs}) == len(jobs)
    for name in preset_names():
        own = [job for job in jobs if job.preset == name]
        assert sum(job.mode == "same-samples" for job in own) == len(TIMES)
        converged = {job.scene.foam.look for job in own if job.mode == "converged" and job.scene.foam is not None}
        assert converged == (set(get_args(Look)) if name in EVERY_LOOK else set())


def test_presets_named_for_every_look_exist() -> None:
    assert set(EVERY_LOOK) <= set(preset_names())


def test_a_baked_frame_is_current(tmp_path: Path) -> None:
    job = replace(jobs_of("default", load_preset("default").scene)[0], size=(8, 5), samples=1)
    content, seconds = baked(job)
    assert seconds > 0.0
    path = truth_file(tmp_path, job.name)
    path.write_bytes(content)
    assert truth_is_current(path, job.scene)
    assert load_truth(path).rgb.shape == (5, 8, 3)
