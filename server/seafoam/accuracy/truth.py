"""The converged float64 picture of a scene, computed once in a separate process and stored on disk."""

import io
import json
import multiprocessing
import os
import time
from collections.abc import Callable
from concurrent.futures import Future
from concurrent.futures import TimeoutError as NotYet
from dataclasses import dataclass, replace
from importlib.metadata import version
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray
from pebble import ProcessPool

from seafoam.accuracy.cache import key_of
from seafoam.quality import EXACT
from seafoam.reference import Sprayed, render, scene_sha256
from seafoam.render.service.frame_cache import DiskCache
from seafoam.render.service.jobs import Draw, Drawn, MeasureJob
from seafoam.scene import Camera, Scene

POLITE = 5
"""Niceness: frames and the web server have priority."""
POLL_SECONDS = 0.2
T = TypeVar("T")

Truth = NDArray[np.float32]
"""(height, width, 4): linear RGB and foam coverage, top row first."""


Measure = Callable[[MeasureJob], tuple[Drawn, ...]]


class SweepStoppedError(Exception):
    """The computation was cancelled."""


@dataclass(frozen=True, slots=True)
class TruthSpec:
    """A float64 picture: scene, its time in seconds, pixels, and the samples along each side of a pixel."""

    scene: Scene
    time: float
    width: int
    height: int
    samples_along: int

    @property
    def file(self) -> str:
        versions = [version("seafoam"), np.__version__]
        at = json.dumps(self.time)
        return key_of(scene_sha256(self.scene), at, self.width, self.height, self.samples_along, versions) + ".npy"


@dataclass(frozen=True)
class Watcher:
    """Receives the progress of a measurement, and can stop it."""

    progress: Callable[[str, float, float | None], None] = lambda stage, share, remaining: None
    """Receives the stage in words, the fraction done, and the remaining seconds if known."""
    stopped: Callable[[], bool] = lambda: False


def find_truth(store: DiskCache, spec: TruthSpec) -> Truth | None:
    content = store.get(spec.file)
    try:
        picture: Truth = np.load(io.BytesIO(content or b""), allow_pickle=False)
    except (ValueError, EOFError):
        return None
    return picture


def sprayed(measure: Measure, scene: Scene, time: float, camera: Camera | None = None) -> Scene | Sprayed:
    """Return what :func:`seafoam.reference.render` takes for a scene: with the drops of its spray, if it has any, as a
    renderer throws them. ``camera`` replaces the scene's."""
    if scene.spray is None:
        return scene
    table = Draw(1, 1, "linear", keep=True, target="spray_births")
    (drawn,) = measure(MeasureJob(scene, EXACT, time, camera or scene.camera, (table,)))
    assert drawn.pixels is not None
    return Sprayed(scene, drawn.pixels[::-1].reshape(3, -1, 4))


def make_truth(store: DiskCache, spec: TruthSpec, measure: Measure, watcher: Watcher | None = None) -> Truth:
    """Return the picture, from the store or computed in a spawned process; on a worker of Dask in this one.

    ``measure`` draws what spray throws. The remaining seconds are estimated from a coarser picture. Raises
    :class:`SweepStoppedError` if the watcher stops it.
    """
    stored = find_truth(store, spec)
    if stored is not None:
        return stored
    scene = sprayed(measure, spec.scene, spec.time)
    if multiprocessing.current_process().daemon:  # a worker of Dask, which may have no children
        truth, _ = _converged(spec, scene)
    else:
        truth = _converged_elsewhere(spec, scene, watcher or Watcher())
    buffer = io.BytesIO()
    np.save(buffer, truth, allow_pickle=False)
    store.put(spec.file, buffer.getvalue())
    return truth


def _converged_elsewhere(spec: TruthSpec, scene: Scene | Sprayed, watcher: Watcher) -> Truth:
    pool = ProcessPool(
        max_workers=1, initializer=os.nice, initargs=(POLITE,), context=multiprocessing.get_context("spawn")
    )
    try:
        coarse = replace(spec, samples_along=max(1, spec.samples_along // 4))
        _, seconds = finished(pool.schedule(_converged, (coarse, scene)), watcher.stopped)
        expected = max(seconds * (spec.samples_along / coarse.samples_along) ** 2, 1e-3)

        def tell(spent: float) -> None:
            watcher.progress("float64 truth", min(spent / expected, 0.99), max(expected - spent, 0.0))

        truth, _ = finished(pool.schedule(_converged, (spec, scene)), watcher.stopped, tell)
    finally:
        pool.stop()  # type: ignore[no-untyped-call]
        pool.join()
    return truth


def finished(future: Future[T], stopped: Callable[[], bool], tell: Callable[[float], None] = lambda _: None) -> T:
    """Return a future's result, or raise what it raises. ``tell``: now and then called with the seconds until now.

    Raises :class:`SweepStoppedError`, and cancels the future, once ``stopped`` says so.
    """
    began = time.perf_counter()
    while True:
        try:
            return future.result(POLL_SECONDS)
        except NotYet:
            # Also what work that timed out raises, which has nothing to wait for.
            if future.done():
                raise
            if stopped():
                future.cancel()
                raise SweepStoppedError from None
            tell(time.perf_counter() - began)


def _converged(spec: TruthSpec, scene: Scene | Sprayed) -> tuple[Truth, float]:
    began = time.perf_counter()
    along = spec.samples_along
    frame = render(scene, time=spec.time, width=spec.width, height=spec.height, samples=along, mode="converged")
    picture = np.concatenate((frame.rgb, frame.alpha[..., None]), axis=-1).astype(np.float32)
    return picture, time.perf_counter() - began
