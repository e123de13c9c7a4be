"""What a renderer's frames are held to: stored float64 frames within bounds, and that there is a picture at all."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from references.bake import load_truth
from seafoam.planner import make_plan
from seafoam.reference.renderer.camera import SampleGrid
from seafoam.render.gl.executor import Executor
from support.exact import UNFILTERED
from support.pictures import colours, draw, rmse
from support.scenes import load_preset

HARD = ("halftone", "fading", "halftone_textured", "listing")
"""Looks of foam that is there or not, so that samples of it can flip."""
NEAR = 0.5
WHOLE = 2.0
FLIPPED = 0.005
TONE = 0.01
LEAST_CONTRAST = 0.01
"""Standard deviation of a picture's colours, below which it is blank."""


@dataclass(frozen=True)
class Parity:
    """A frame against its float64 truth.

    ``near``, ``whole``: RMSE in levels, more than a degree below the horizon without the worst pixels, and of all.
    ``flipped``: share of samples with foam in one picture only. ``tone``: mean error of coverage over 8 × 8 pixels.
    """

    size: tuple[int, int]
    near: float
    whole: float
    flipped: float
    tone: float
    hard: bool
    """Whether ``flipped`` and ``tone`` are bounded."""

    def exceeded(self) -> list[str]:
        """The bounds that do not hold, in words."""
        bounds = [("below 1°", self.near, NEAR), ("whole frame", self.whole, WHOLE)]
        if self.hard:
            bounds += [("flipped samples", self.flipped, FLIPPED), ("tone", self.tone, TONE)]
        # NaN exceeds every bound.
        return [f"{what} {found:.4g} > {bound:g}" for what, found, bound in bounds if not found <= bound]


def parity(executor: Executor, preset: str, time: float) -> Parity:
    """Draw a preset without maps and filters, from the samples that its stored frame has, and compare."""
    scene = load_preset(preset).scene
    truth = load_truth(f"{preset}.same.{time:.1f}")
    want = colours(truth.rgb)
    size = (want.shape[1], want.shape[0])
    samples = draw(executor, make_plan(scene, UNFILTERED), scene.camera, time=time, size=size, output="samples")
    linear = mean_of(samples, size)
    got = colours(linear)
    below = SampleGrid(scene.camera, *size).depression > np.radians(1.0)
    height, width = truth.alpha.shape
    cells = (linear[..., 3] - truth.alpha)[: height // 8 * 8, : width // 8 * 8].reshape(height // 8, 8, width // 8, 8)
    return Parity(
        size=size,
        near=rmse(*without_the_worst(got[below], want[below])),
        whole=rmse(got, want),
        flipped=float(np.mean((samples[..., 3] > 0.0) != truth.foam)),
        tone=float(np.abs(cells.mean(axis=(1, 3))).mean()),
        hard=scene.foam is not None and scene.foam.look in HARD,
    )


def without_the_worst(
    got: NDArray[np.float64], want: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Pixels (n, 3) less the worst in ten thousand: a ray that just touches a crest in the sun falls either way."""
    order = np.argsort(np.abs(got - want).max(axis=1))
    kept = order[: len(order) - math.ceil(1e-4 * len(order))]
    return got[kept], want[kept]


def mean_of(samples: NDArray[np.float32], size: tuple[int, int]) -> NDArray[np.float32]:
    """The frame of its samples, (height, width, 4): one draw gives both."""
    side = samples.shape[1] // size[0]
    return samples.reshape(size[1], side, size[0], side, 4).mean(axis=(1, 3), dtype=np.float64).astype(np.float32)


def faults(light: NDArray[Any]) -> list[str]:
    """What is wrong with linear light of any frame, in words; of a picture, nothing."""
    if not np.isfinite(light).all():
        return ["values that are not finite"]
    found = []
    if (light < 0.0).any():
        found.append("values below 0")
    if colours(light).std() <= LEAST_CONTRAST:
        found.append("a blank picture")
    return found
