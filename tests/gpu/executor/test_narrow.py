"""Pictures that are drawn at a part of their width and enlarged."""

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from seafoam.effects.effect import ABOVE
from seafoam.planner import make_plan
from seafoam.quality import TIERS, Quality, SurfaceQuality
from seafoam.render.gl.executor import Executor, Output
from support.pictures import draw
from support.scenes import load_preset

STANDARD = TIERS["standard"]
SIZES = ((96, 54), (50, 7), (51, 7), (2, 3), (1, 1))


def narrow(width: int) -> Quality:
    return STANDARD.model_copy(update={"pixel_width": width})


def drawn(
    executor: Executor, preset: str, quality: Quality, size: tuple[int, int], output: Output = "rgba8"
) -> NDArray[np.float64]:
    """A frame, (height, width, 4)."""
    found = load_preset(preset)
    plan = make_plan(found.scene, quality)
    return draw(executor, plan, found.scene.camera, time=found.time, size=size, output=output).astype(np.float64)


def along_rows(seen: NDArray[np.float64], x: NDArray[np.float64]) -> NDArray[np.float64]:
    """Rows (height, columns, 4) at places x (height, width) along them, columns: Catmull and Rom's cubic."""
    columns, first = seen.shape[1], np.floor(x).astype(int)
    f = (x - first)[..., None]
    p = [np.take_along_axis(seen, np.clip(first + step, 0, columns - 1)[..., None], 1) for step in (-1, 0, 1, 2)]
    slopes = (0.5 * (p[2] - p[0]), 0.5 * (p[3] - p[1]))
    # Hermite's form of the same cubic.
    found = (
        (2.0 * f**3 - 3.0 * f**2 + 1.0) * p[1]
        + (f**3 - 2.0 * f**2 + f) * slopes[0]
        + (3.0 * f**2 - 2.0 * f**3) * p[2]
        + (f**3 - f**2) * slopes[1]
    )
    return np.clip(found, np.minimum(p[1], p[2]), np.maximum(p[1], p[2]))


def enlarged(picture: NDArray[np.float64], width: int) -> NDArray[np.float64]:
    """What is shown of (height, columns, 4), the top row first: docs/formulae.md, section 1."""
    colors = np.maximum(picture[..., :3], 0.0)
    seen = np.concatenate([colors / (1.0 + colors.max(-1, keepdims=True)), picture[..., 3:]], -1)
    height, columns = seen.shape[:2]
    # Rows count from the bottom.
    rows = np.arange(height)[::-1]
    shift = np.where(rows % 2 == 0, -0.25, 0.25)[:, None]
    middle = (np.arange(width) + 0.5) / width * columns - 0.5
    own = along_rows(seen, middle - shift)
    f = (middle - shift) % 1.0
    sides = [np.abs(np.arange(height) + step) for step in (-1, 1)]
    sides[1] = np.where(sides[1] == height, max(height - 2, 0), sides[1])
    sides[0] = np.minimum(sides[0], height - 1)
    beside = np.clip(np.floor(middle + shift + 0.5).astype(int), 0, columns - 1)[..., None]
    around = sum(np.take_along_axis(seen[side], beside, 1) for side in sides) / 2.0
    share = (0.1 * 4.0 * f * (1.0 - f))[..., None]
    found = (1.0 - share) * own + share * around
    return np.concatenate([found[..., :3] / (1.0 - found[..., :3].max(-1, keepdims=True)), found[..., 3:]], -1)


@pytest.mark.parametrize("width", [2, 3, 4])
def test_what_is_drawn_narrow_is_enlarged_by_a_cubic_and_the_rows_beside(executor: Executor, width: int) -> None:
    quality = narrow(width).model_copy(update={"target": "RGBA32F"})
    for size in SIZES:
        samples = drawn(executor, "default", quality, size, "samples")
        assert samples.shape[:2] == (size[1], -(-size[0] // width))
        want = enlarged(samples, size[0])
        np.testing.assert_allclose(drawn(executor, "default", quality, size, "linear"), want, rtol=2e-4, atol=1e-5)


@pytest.mark.parametrize("preset", ["default", "coastline", "swell"])
def test_a_third_of_the_width_errs_less_than_fewer_pixels_along_both_axes(executor: Executor, preset: str) -> None:
    """As many samples either way, and a twelfth less error at least."""
    size = (480, 270)
    truth = drawn(executor, preset, TIERS["high"], size)[..., :3]
    third = drawn(executor, preset, narrow(3), size)[..., :3]
    small = drawn(executor, preset, STANDARD, (277, 156)).astype(np.uint8)
    plain = np.asarray(Image.fromarray(small[..., :3]).resize(size, Image.Resampling.BICUBIC), np.float64)
    errors = [float(np.sqrt(np.square(picture - truth).mean())) for picture in (third, plain)]
    assert errors[0] < 0.92 * errors[1], errors


@pytest.mark.parametrize("preset", ["storm", "spray-on-rocks", "boat-race", "moonlight"])
def test_narrow_pixels_change_no_light_in_the_mean(executor: Executor, preset: str) -> None:
    """Drops, stars, boats and foam hide and light as much, however wide a pixel is: within two hundredths."""
    means = [drawn(executor, preset, narrow(width), (384, 216), "linear").mean((0, 1)) for width in (1, 3)]
    np.testing.assert_allclose(means[1], means[0], rtol=0.02, atol=0.002)


@pytest.mark.parametrize("preset", ["boat-race", "storm"])
def test_what_stands_before_the_scenery_is_drawn_at_full_width(executor: Executor, preset: str) -> None:
    """Rays to drops begin where wider tiles of rays begin, and may end elsewhere within the tolerance: one in 100."""
    scene, exact = load_preset(preset).scene, SurfaceQuality(tolerance=0.02)
    qualities = [narrow(width).model_copy(update={"surface": exact}) for width in (1, 2, 3)]
    plans = [make_plan(scene, quality).model_copy(update={"linear": ABOVE}) for quality in qualities]
    above = [draw(executor, plan, scene.camera, time=10.0, size=(96, 54), output="linear") for plan in plans]
    assert above[0][..., 3].max() > 0.4
    for one in above[1:]:
        assert (np.abs(one - above[0]).max(-1) > 1e-3).mean() < 0.01
