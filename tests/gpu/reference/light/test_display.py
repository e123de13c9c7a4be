"""The display of a finished frame, tone curves and glare, against their float64 forms (docs/formulae.md, section 7)."""

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import ndimage

from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.reference.light import light as display
from seafoam.reference.types import Floats, smoothstep
from seafoam.render.gl.executor import Executor
from support.pictures import ROUNDED
from support.report import Report
from support.scenes import Camera, Light, Ripples, Scene, Sky, Water

LEVELS = 6
MOST = 4096.0


def glared(frame: Floats, share: float) -> Floats:
    """The finished linear frame (H, W, 3), rows from the bottom, with a ``share`` of its light spread; (H, W, 3)."""
    height, width = frame.shape[:2]
    rows, columns = -(-height // 4), -(-width // 4)
    padded = np.pad(np.minimum(frame, MOST), ((0, 4 * rows - height), (0, 4 * columns - width), (0, 0)), mode="edge")
    levels = [padded.reshape(rows, 4, columns, 4, 3).mean(axis=(1, 3))]
    for k in range(1, LEVELS):
        part = 4 << k
        rows, columns = -(-height // part), -(-width // part)
        y, x = np.meshgrid(2.0 * np.arange(rows) + 1.0, 2.0 * np.arange(columns) + 1.0, indexing="ij")
        levels.append(_taps(levels[-1], x, y, 0.75))
    total, weight = levels[-1], 1.0
    for finer, coarser in zip(levels[-2::-1], levels[:0:-1], strict=True):
        share_of = 1.0 - float(smoothstep(0.08, 0.25, 1.0 / coarser.shape[0]))
        y, x = np.meshgrid(
            0.5 * np.arange(finer.shape[0]) + 0.25, 0.5 * np.arange(finer.shape[1]) + 0.25, indexing="ij"
        )
        total, weight = finer + share_of * _taps(total, x, y, 0.5), 1.0 + share_of * weight
    y, x = np.meshgrid(0.25 * np.arange(height) + 0.125, 0.25 * np.arange(width) + 0.125, indexing="ij")
    return frame + share / LEVELS * (_bilinear(total, x, y) - weight * frame)


def _taps(image: Floats, x: Floats, y: Floats, apart: float) -> Floats:
    """Mean of four bilinear readings around places (r, c), texels, ``apart`` texels from them along both axes."""
    return 0.25 * sum(
        (_bilinear(image, x + i * apart, y + j * apart) for i in (-1.0, 1.0) for j in (-1.0, 1.0)),
        start=np.zeros((*x.shape, 3)),
    )


def _bilinear(image: Floats, x: Floats, y: Floats) -> Floats:
    """An image (h, w, 3) at places (r, c) in texels from its corner, its edges continued; (r, c, 3)."""
    parts = (
        ndimage.map_coordinates(part, (y - 0.5, x - 0.5), order=1, mode="nearest") for part in np.moveaxis(image, -1, 0)
    )
    return np.stack(list(parts), axis=-1)


SUN = Camera(position=(0.0, 3.0, 0.0), yaw=np.pi / 2, pitch=0.1, fov=0.7)


def scene(**of_light: object) -> Scene:
    """The sun over rippled water, in the middle of the picture."""
    return Scene(light=Light(sun_elevation=0.1, sky=Sky(), **of_light), water=Water(ripples=Ripples()))


def both(executor: Executor, of: Scene, size: tuple[int, int]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Linear frame and picture, levels; rows from the top."""
    plan = make_plan(of, TIERS["standard"])
    linear, shown = (
        executor.render(plan, time=1.0, camera=SUN, width=size[0], height=size[1], output=output).pixels[..., :3]
        for output in ("linear", "rgba8")
    )
    return linear.astype(np.float64), shown.astype(np.float64)


@pytest.mark.parametrize("size", [(160, 90), (149, 83), (60, 34), (5, 3)])
@pytest.mark.parametrize(("tone", "share"), [("filmic", 0.0), ("photographic", 0.0), ("photographic", 0.3)])
def test_a_picture_is_its_linear_frame_by_the_formula(
    executor: Executor, report: Report, size: tuple[int, int], tone: str, share: float
) -> None:
    linear, shown = both(executor, scene(tone=tone, glare=share), size)
    spread = glared(linear[::-1], share)[::-1]
    off = np.abs(shown - 255.0 * display.srgb(display.tone(np.maximum(spread, 0.0), tone)))
    # Rounding, and half floats of the levels.
    bound = ROUNDED if share == 0.0 else 1.0
    title = "A picture against its linear frame in float64, levels"
    report.within(title, size=f"{size[0]} × {size[1]}", tone=tone, glare=share, worst=(off.max(), bound))


def test_linear_frames_are_without_glare(executor: Executor) -> None:
    plain, _ = both(executor, scene(), (96, 54))
    spread, _ = both(executor, scene(glare=0.4), (96, 54))
    assert (plain == spread).all()
