"""The converged float64 picture of a scene, computed once in a separate process and stored on disk."""

import io
import json
import multiprocessing
import os
import time
from collections.abc import Callable
from concurrent.futures import TimeoutError as NotYet
from importlib.metadata import version
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pebble import ProcessPool

from seafoam.accuracy.cache import Store, key_of
from seafoam.reference import render, scene_sha256
from seafoam.scene.models import Scene

SAMPLES_ALONG = 16
"""Samples along each side of a pixel: 256 per pixel."""
POLITE = 5
"""Niceness: frames and the web server have priority."""
POLL_SECONDS = 0.2

Truth = NDArray[np.float32]
"""(height, width, 4): linear RGB and foam coverage, top row first."""


class SweepStoppedError(Exception):
    """The computation was cancelled."""


def find_truth(store: Store, scene: Scene, at: float, width: int, height: int, along: int) -> Truth | None:
    """Return the stored picture, if there is one."""
    content = store.get("truth", _name(scene, at, width, height, along))
    if content is None:
        return None
    try:
        picture: NDArray[Any] = np.load(io.BytesIO(content), allow_pickle=False)
    except (ValueError, EOFError):
        return None
    good = picture.shape == (height, width, 4) and picture.dtype == np.float32
    return picture if good else None


def make_truth(
    store: Store,
    scene: Scene,
    at: float,
    width: int,
    height: int,
    along: int = SAMPLES_ALONG,
    *,
    progress: Callable[[float, float], None] = lambda share, remaining: None,
    stopped: Callable[[], bool] = lambda: False,
) -> Truth:
    """Return the picture, from the store or computed in a spawned process; on a worker of Dask in this one.

    ``progress`` receives the fraction done and the remaining seconds, estimated from a coarser picture.
    Raises :class:`SweepStoppedError` once ``stopped`` returns true.
    """
    stored = find_truth(store, scene, at, width, height, along)
    if stored is not None:
        return stored
    if multiprocessing.current_process().daemon:  # a worker of Dask, which may have no children
        truth, _ = _converged(scene, at, width, height, along)
    else:
        truth = _converged_elsewhere((scene, at, width, height, along), progress, stopped)
    buffer = io.BytesIO()
    np.save(buffer, truth, allow_pickle=False)
    store.put("truth", _name(scene, at, width, height, along), buffer.getvalue())
    return truth


def _converged_elsewhere(
    asked: tuple[Scene, float, int, int, int],
    progress: Callable[[float, float], None],
    stopped: Callable[[], bool],
) -> Truth:
    """Return the picture, computed in a spawned process. asked: scene, time, width, height, samples along."""
    *picture, along = asked
    pool = ProcessPool(max_workers=1, context=multiprocessing.get_context("spawn"))
    try:
        coarse = max(1, along // 4)
        _, seconds = _wait(pool, (*picture, coarse), lambda _: None, stopped)
        expected = max(seconds * (along / coarse) ** 2, 1e-3)
        truth, _ = _wait(
            pool,
            asked,
            lambda spent: progress(min(spent / expected, 0.99), max(expected - spent, 0.0)),
            stopped,
        )
    finally:
        pool.stop()  # type: ignore[no-untyped-call]
        pool.join()
    return truth


def _wait(
    pool: ProcessPool, job: tuple[Any, ...], progress: Callable[[float], None], stopped: Callable[[], bool]
) -> tuple[Truth, float]:
    future = pool.schedule(_politely, job)
    began = time.perf_counter()
    while True:
        try:
            done: tuple[Truth, float] = future.result(POLL_SECONDS)
            return done
        except NotYet:
            if stopped():
                raise SweepStoppedError from None
            progress(time.perf_counter() - began)


def _politely(*asked: Any) -> tuple[Truth, float]:
    """In the separate process: let frames and the web server go first."""
    if hasattr(os, "nice"):
        os.nice(max(0, POLITE - os.nice(0)))
    return _converged(*asked)


def _converged(scene: Scene, at: float, width: int, height: int, along: int) -> tuple[Truth, float]:
    """Return the picture and the seconds it took."""
    began = time.perf_counter()
    frame = render(scene, time=at, width=width, height=height, samples=along, mode="converged")
    picture = np.concatenate((frame.rgb, frame.alpha[..., None]), axis=-1).astype(np.float32)
    return picture, time.perf_counter() - began


def _name(scene: Scene, at: float, width: int, height: int, along: int) -> str:
    versions = [version("seafoam"), np.__version__]
    return key_of(scene_sha256(scene), json.dumps(at), width, height, along, versions) + ".npy"
