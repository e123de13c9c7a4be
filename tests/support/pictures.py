"""Pictures that tests draw, and how far they are apart."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from seafoam.framegraph.plan import FramePlan
from seafoam.planner import make_plan
from seafoam.quality import Quality
from seafoam.render.gl.executor import Executor, Output
from support.scenes import Camera, Scene

ROUNDED = 0.6
"""Levels that a number may be from the byte that it is written as: what Direct3D's conversion rules grant to hardware.
Mesa's drivers keep to half a level, an NVIDIA H200 to 0.561."""

Size = tuple[int, int]


def draw(
    executor: Executor, plan: FramePlan, camera: Camera, *, time: float, size: Size, output: Output = "rgba8"
) -> NDArray[Any]:
    """A frame's pixels, (height, width, 4), rows from the top; ``size`` is its width and height.

    ``uint8``, or float32 of linear light where ``output`` is "linear", and of every sample where it is "samples".
    """
    frame = executor.render(plan, time=time, camera=camera, width=size[0], height=size[1], output=output)
    return frame.pixels


def samples(
    executor: Executor, scene: Scene, quality: Quality, camera: Camera | None = None, *, size: Size, time: float = 0.0
) -> NDArray[np.float32]:
    """Linear light of every sample of a scene's frame, from its own camera or another."""
    return draw(executor, make_plan(scene, quality), camera or scene.camera, time=time, size=size, output="samples")


def linear(
    executor: Executor, scene: Scene, quality: Quality, camera: Camera | None = None, *, size: Size, time: float = 0.0
) -> NDArray[np.float32]:
    """Linear light and coverage of every pixel of a scene's frame, from its own camera or another."""
    return draw(executor, make_plan(scene, quality), camera or scene.camera, time=time, size=size, output="linear")


def draw_target(
    executor: Executor, plan: FramePlan, target: str, time: float = 0.0, camera: Camera | None = None
) -> NDArray[np.float32]:
    """What a frame leaves in one of the plan's targets, (height, width, 4): row 0 is GL's first, at the least z."""
    shown = plan.model_copy(update={"linear": target})
    drawn: NDArray[np.float32] = draw(executor, shown, camera or Camera(), time=time, size=(16, 16), output="linear")
    return drawn[::-1]


def colours(pixels: NDArray[Any]) -> NDArray[np.float64]:
    """Linear light as a display takes it, (height, width, 3), in [0, 1]."""
    return np.clip(pixels[..., :3].astype(np.float64), 0.0, 1.0)


def levels(a: NDArray[Any], b: NDArray[Any]) -> NDArray[np.float64]:
    """Largest difference of each pixel's colours, clipped at white, in levels: display white = 255; (height, width)."""
    return 255.0 * np.abs(colours(a) - colours(b)).max(axis=-1)


def rmse(a: NDArray[Any], b: NDArray[Any]) -> float:
    """Root mean square of the differences of colours, clipped at white, in levels."""
    return float(255.0 * np.sqrt(np.mean((colours(a) - colours(b)) ** 2)))


def rms(off: NDArray[Any]) -> float:
    """Root mean square."""
    return float(np.sqrt(np.mean(np.square(off, dtype=np.float64))))
