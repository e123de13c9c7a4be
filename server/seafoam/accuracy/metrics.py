"""How far two pictures are apart. Pictures are (height, width, 4): linear RGB and foam coverage, rows from the top."""

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seafoam.accuracy.model import Errors
from seafoam.reference.light.light import srgb, tone

LEVEL = 255.0
"""Errors are quoted in 8-bit levels of linear light: display white = 255."""
FOAM = 0.5
"""Coverage from which a pixel counts as foam."""

Picture = NDArray[Any]


def white(picture: Picture) -> NDArray[np.float64]:
    """Linear RGB clipped at display white: glitter beyond it is white on any screen."""
    return np.clip(picture[..., :3].astype(np.float64), 0.0, 1.0)


def rmse(picture: Picture, truth: Picture) -> float:
    """Root mean square difference of linear RGB up to white, levels."""
    return float(LEVEL * np.sqrt(np.mean((white(picture) - white(truth)) ** 2)))


def greatest(picture: Picture, truth: Picture) -> float:
    """Greatest difference of a channel of linear RGB up to white, levels."""
    return float(LEVEL * np.max(np.abs(white(picture) - white(truth))))


def displayed(picture: Picture) -> NDArray[np.float32]:
    """The picture as a screen shows it: tone-mapped sRGB, (height, width, 3) in [0, 1]."""
    shown = srgb(tone(np.maximum(picture[..., :3].astype(np.float64), 0.0)))
    return np.ascontiguousarray(np.clip(shown, 0.0, 1.0), np.float32)


def flip(picture: Picture, truth: Picture) -> float:
    """Mean FLIP (LDR, 67 pixels a degree) of the displayed pictures, 0 to 1."""
    import flip_evaluator

    _, mean, _ = flip_evaluator.evaluate(displayed(truth), displayed(picture), "LDR", applyMagma=False)
    return float(mean)


def coverage(picture: Picture, truth: Picture) -> float:
    """Root mean square difference of foam coverage, 0 to 1."""
    return float(np.sqrt(np.mean((picture[..., 3].astype(np.float64) - truth[..., 3]) ** 2)))


def flipped(picture: Picture, truth: Picture) -> float:
    """Share of pixels that are foam in one picture alone."""
    return float(np.mean((picture[..., 3] > FOAM) != (truth[..., 3] > FOAM)))


def popping(frames: Sequence[Picture]) -> float | None:
    """Share of living foam that is gone in the next frame, in the worst pair; None where no foam ever lives."""
    alive = [frame[..., 3] > FOAM for frame in frames]
    lost = [
        np.count_nonzero(before & ~after) / np.count_nonzero(before)
        for before, after in pairwise(alive)
        if before.any()
    ]
    return float(max(lost)) if lost else None


def errors(frames: Sequence[Picture], truth: Picture) -> Errors:
    """All of it. ``frames``: a short sequence whose first is at the truth's time."""
    picture = frames[0]
    return Errors(
        rmse=rmse(picture, truth),
        max=greatest(picture, truth),
        flip=flip(picture, truth),
        coverage=coverage(picture, truth),
        flipped=flipped(picture, truth),
        popping=popping(frames),
    )
