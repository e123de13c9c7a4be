"""Error metrics of two pictures, each (height, width, 4): linear RGB and foam coverage, top row first."""

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seafoam.accuracy.model import Errors
from seafoam.reference.light.light import srgb, tone
from seafoam.scene import Scene, ToneCurve

LEVEL = 255.0
"""Errors are given in 8-bit levels of linear light: display white = 255."""
FOAM = 0.5
"""Coverage above which a pixel counts as foam."""

Picture = NDArray[Any]


def white(picture: Picture) -> NDArray[np.float64]:
    """Return linear RGB clipped at display white, because brighter glitter is white on any screen."""
    return np.clip(picture[..., :3].astype(np.float64), 0.0, 1.0)


def rmse(picture: Picture, truth: Picture) -> float:
    """Return the root mean square difference of linear RGB up to white, levels."""
    return float(LEVEL * np.sqrt(np.mean((white(picture) - white(truth)) ** 2)))


def greatest(picture: Picture, truth: Picture) -> float:
    """Return the maximum difference of a channel of linear RGB up to white, levels."""
    return float(LEVEL * np.max(np.abs(white(picture) - white(truth))))


def tone_curve(scene: Scene) -> ToneCurve | None:
    """Return the scene's tone curve, or None where it is unlit and light is only clipped."""
    return None if scene.light is None else scene.light.tone


def displayed(picture: Picture, curve: ToneCurve | None) -> NDArray[np.float32]:
    """Return the displayed picture, by a :func:`tone_curve` and without glare: sRGB, (height, width, 3) in [0, 1]."""
    light = np.maximum(picture[..., :3].astype(np.float64), 0.0)
    shown = srgb(np.minimum(light, 1.0) if curve is None else tone(light, curve))
    return np.ascontiguousarray(np.clip(shown, 0.0, 1.0), np.float32)


def flip(picture: Picture, truth: Picture, curve: ToneCurve | None) -> float:
    """Return the mean FLIP (LDR, 67 pixels per degree) of the pictures displayed by a :func:`tone_curve`, 0 to 1."""
    import flip_evaluator

    _, mean, _ = flip_evaluator.evaluate(displayed(truth, curve), displayed(picture, curve), "LDR", applyMagma=False)
    return float(mean)


def coverage(picture: Picture, truth: Picture) -> float:
    """Return the root mean square difference of foam coverage, 0 to 1."""
    return float(np.sqrt(np.mean((picture[..., 3].astype(np.float64) - truth[..., 3]) ** 2)))


def flipped(picture: Picture, truth: Picture) -> float:
    """Return the fraction of pixels that are foam in only one of the pictures."""
    return float(np.mean((picture[..., 3] > FOAM) != (truth[..., 3] > FOAM)))


def popping(frames: Sequence[Picture]) -> float | None:
    """Return the fraction of foam that disappears by the next frame, in the worst pair; None without foam."""
    alive = [frame[..., 3] > FOAM for frame in frames]
    lost = [
        np.count_nonzero(before & ~after) / np.count_nonzero(before)
        for before, after in pairwise(alive)
        if before.any()
    ]
    return float(max(lost)) if lost else None


def errors(frames: Sequence[Picture], truth: Picture, curve: ToneCurve | None) -> Errors:
    """Return all metrics of a short sequence whose first frame is at the reference picture's time."""
    compared = frames[0], truth
    light = {"rmse": rmse(*compared), "max": greatest(*compared), "flip": flip(*compared, curve)}
    return Errors(**light, coverage=coverage(*compared), flipped=flipped(*compared), popping=popping(frames))
