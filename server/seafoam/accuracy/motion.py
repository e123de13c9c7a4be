"""Flicker of a moving picture: changes between frames other than smooth motion."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seafoam.accuracy.metrics import LEVEL, Picture, displayed
from seafoam.scene.light import ToneCurve

LUMA = (0.2126, 0.7152, 0.0722)
"""Weights of R, G and B (ITU-R BT.709)."""


def shown(picture: Picture, curve: ToneCurve | None) -> NDArray[np.float64]:
    """Luma of a linear picture as a screen shows it, (height, width) in [0, 1]: tone-mapped and sRGB-encoded.

    picture: (height, width, ≥ 3) of linear light; curve: ``light.tone``, None where the scene is unlit.
    Encoded, because eyes see steps of it about alike, dark or bright.
    """
    result: NDArray[np.float64] = displayed(picture, curve).astype(np.float64) @ np.array(LUMA)
    return result


def flicker(frames: Sequence[NDArray[Any]]) -> float:
    """Root mean square of the second difference in time, x(t − 1) − 2 x(t) + x(t + 1), 8-bit levels.

    frames: at least three, evenly apart in time, each (height, width) in [0, 1]. What stays scores 0, and so does what
    grows or fades evenly; what comes for a frame and goes again scores 2.4 times its height there. In frequencies it
    is a high pass, 4 sin²(πf/F) at f of F frames a second: 0.01 at 1 Hz and 4 at 30 Hz of 60. A moving edge scores
    too, so a clip is judged against the same clip from many samples (:func:`excess`). Ours; no model of the eye.

    Raises ``ValueError`` for fewer frames or frames of different shapes.
    """
    if len(frames) < 3 or any(frame.ndim != 2 or frame.shape != frames[0].shape for frame in frames):
        raise ValueError("flicker requires at least three frames (height, width), all of one shape")
    square, count = 0.0, 0
    for before, now, after in zip(frames[:-2], frames[1:-1], frames[2:], strict=True):
        bend = before.astype(np.float64) - 2.0 * now + after
        square += float((bend**2).sum())
        count += bend.size
    return LEVEL * float(np.sqrt(square / count))


def excess(frames: Sequence[NDArray[Any]], truth: Sequence[NDArray[Any]], floor: float = 0.05) -> float:
    """Flicker of a clip over that of the same clip drawn with many samples, ≥ 0: 1 is no more than motion itself.

    frames, truth: as :func:`flicker` takes them; floor: least flicker of the truth, levels, above 0, so that a still
    clip of noise is no infinity. Raises ``ValueError`` as :func:`flicker` does, and where the clips differ in length.
    """
    if len(frames) != len(truth) or not floor > 0.0:
        raise ValueError("both clips must have as many frames, and the floor must be above 0")
    return flicker(frames) / max(flicker(truth), floor)
