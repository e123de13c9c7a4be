"""Float64 frames that drawn ones are judged by: ``python tests/references/bake.py [--preset NAME ...] [--force]``.

With ``--scheduler tcp://host:8786`` on the workers of a Dask cluster. A frame is a compressed .npz file, the same bytes
for the same frame. Linear RGB is held to [0, 4] and stored as round(65535 √(x/4)): its error is below 0.01/255 at white
and less in the dark. Alpha is round(65535 a). Values are stored as differences along rows, high and low bytes apart.
"""

import argparse
import io
import json
from concurrent.futures import as_completed
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import get_args

import numpy as np
from numpy.typing import NDArray
from rich.progress import track

from seafoam.accuracy.truth import sprayed
from seafoam.extras import MissingExtraError
from seafoam.files import write_whole
from seafoam.processes import SCHEDULER, NoClusterError, executor
from seafoam.reference import Mode, ReferenceFrame, render, scene_sha256
from seafoam.render.gl.executor import Executor
from seafoam.render.service.jobs import measure
from seafoam.scene import Look, Scene, load_preset, preset_names

DIRECTORY = Path(__file__).parent
TIMES = (0.0, 2.7, 1000003.5)  # times of same-samples frames, s
SAME_SIZE, COSTLY_SIZE = (320, 180), (160, 90)
"""Their size in pixels: of most, and of scenes that take ten times as long."""
SAME_SAMPLES = 4
CONVERGED_TIME = 2.7
CONVERGED_SIZE = (160, 90)
CONVERGED_SAMPLES = 16
EVERY_LOOK = ("default", "paper-halftone")  # presets with converged frames, one for every look
PROCESSES = 2
BRIGHTEST = 4.0
LEVELS = 65535


@dataclass(frozen=True)
class Job:
    """One frame to bake; its name is that of its file without the suffix."""

    name: str
    scene: Scene
    time: float
    size: tuple[int, int]
    samples: int
    mode: Mode


@dataclass(frozen=True, eq=False)
class Truth:
    """A baked frame, rows from the top: linear RGB (H, W, 3) in [0, 4], mean foam amount (H, W), and where a sample has
    foam (H·n, W·n), None in converged mode."""

    rgb: NDArray[np.float64]
    alpha: NDArray[np.float64]
    foam: NDArray[np.bool_] | None


def same_size(scene: Scene) -> tuple[int, int]:
    """Width and height of a scene's same-samples frames, pixels."""
    caustics = None if scene.light is None else scene.light.caustics
    costly = (scene.shore, scene.sea, scene.drift, scene.breaker, caustics)
    return COSTLY_SIZE if scene.boats or any(part is not None for part in costly) else SAME_SIZE


def jobs_of(preset: str) -> list[Job]:
    """Every frame of a preset, in baking order."""
    scene = load_preset(preset).scene
    size = same_size(scene)
    jobs = [Job(f"{preset}.same.{time:.1f}", scene, time, size, SAME_SAMPLES, "same-samples") for time in TIMES]
    for look in get_args(Look) if preset in EVERY_LOOK else ():
        variant = scene.model_copy(update={"foam": scene.foam.model_copy(update={"look": look})})
        name = f"{preset}.converged.{look}"
        jobs.append(Job(name, variant, CONVERGED_TIME, CONVERGED_SIZE, CONVERGED_SAMPLES, "converged"))
    return jobs


def truth_file(name: str) -> Path:
    """Where the frame of a job is kept."""
    return DIRECTORY / f"{name}.npz"


def truth_bytes(frame: ReferenceFrame, job: Job) -> bytes:
    """A frame as the content of its file."""
    rgb = np.rint(LEVELS * np.sqrt(np.clip(frame.rgb, 0.0, BRIGHTEST) / BRIGHTEST)).astype(np.uint16)
    alpha = np.rint(LEVELS * np.clip(frame.alpha, 0.0, 1.0)).astype(np.uint16)
    meta = {"scene_sha256": scene_sha256(job.scene), "numpy": np.__version__, "columns": frame.amount.shape[1]}
    arrays = {
        "meta": np.frombuffer(json.dumps(meta).encode(), np.uint8),
        "rgb": _planes(rgb),
        "alpha": _planes(alpha[:, :, None]),
    }
    if job.mode == "same-samples":
        arrays["foam"] = np.packbits(frame.amount > 0.0, axis=1)
    buffer = io.BytesIO()
    np.savez_compressed(buffer, **arrays)
    return buffer.getvalue()


def load_truth(name: str) -> Truth:
    """The baked frame of a job."""
    with np.load(truth_file(name), allow_pickle=False) as stored:
        meta = json.loads(stored["meta"].tobytes())
        rgb, alpha = (_joined(stored[name]).astype(np.float64) / LEVELS for name in ("rgb", "alpha"))
        columns = meta["columns"] if "columns" in meta else meta["width"] * meta["samples"]
        foam = np.unpackbits(stored["foam"], axis=1, count=columns).astype(np.bool_) if "foam" in stored else None
    return Truth(BRIGHTEST * rgb**2, alpha[:, :, 0], foam)


def truth_is_current(name: str, scene: Scene) -> bool:
    """Whether the baked frame of a job shows exactly this scene; False where there is none."""
    if not truth_file(name).is_file():
        return False
    with np.load(truth_file(name), allow_pickle=False) as stored:
        return json.loads(stored["meta"].tobytes())["scene_sha256"] == scene_sha256(scene)


def _planes(values: NDArray[np.uint16]) -> NDArray[np.uint8]:
    """Differences along rows of (H, W, C), modulo 2¹⁶, as (2, C, H, W) bytes: high, then low."""
    steps = np.diff(np.moveaxis(values, 2, 0), axis=2, prepend=np.uint16(0))
    return np.stack(((steps >> 8).astype(np.uint8), (steps & 255).astype(np.uint8)))


def _joined(planes: NDArray[np.uint8]) -> NDArray[np.uint16]:
    """Inverse of :func:`_planes`."""
    steps = (planes[0].astype(np.uint16) << 8) | planes[1]
    return np.moveaxis(np.cumsum(steps, axis=2, dtype=np.uint16), 0, 2)


def main() -> None:
    """Bake frames that are missing or show another scene; with ``--force`` all of them."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("--preset", action="append", choices=preset_names(), help="only this one; may be repeated")
    parser.add_argument("--force", action="store_true", help="bake current frames too")
    parser.add_argument("--scheduler", help=SCHEDULER)
    options = parser.parse_args()
    jobs = [job for name in options.preset or preset_names() for job in jobs_of(name)]
    jobs = [job for job in jobs if options.force or not truth_is_current(job.name, job.scene)]
    try:
        with executor(options.scheduler, PROCESSES) as pool:
            running = {}
            drawing = cache(Executor)
            for job in jobs:
                at = {"time": job.time, "width": job.size[0], "height": job.size[1], "samples": job.samples}
                scene = sprayed(lambda what: measure(drawing(), what), job.scene, job.time)
                running[pool.submit(render, scene, **at, mode=job.mode)] = job
            for done in track(as_completed(running), "frames", len(jobs)):
                write_whole(truth_file(running[done].name), truth_bytes(done.result(), running[done]))
    except (MissingExtraError, NoClusterError) as error:
        raise SystemExit(str(error)) from error


if __name__ == "__main__":
    main()
