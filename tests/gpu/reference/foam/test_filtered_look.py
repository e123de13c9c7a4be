"""The filtered look: right coverage at every scale, round edges up close, no shimmer far away (docs/formulae.md, 5)."""

import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import ndimage

from seafoam.render.gl.executor import Executor
from support.exact import SQUARE
from support.pictures import linear, rms
from support.report import Report
from support.scenes import Camera, Foam, HeightSaturation, Look, Scene, load_preset

TILE = 5.12
"""512 texels of 1 cm."""
FOV = 0.02
"""So narrow that every pixel has the same footprint to 10⁻⁴."""


def flat(saturation: float, look: Look = "filtered", mask: str = "vac-1.5", **foam: Any) -> Scene:
    """Unlit flat water, the same saturation everywhere: at height 0 (H − H0)/(Hmax − H0) is −H0 for Hmax = 1 + H0."""
    source = HeightSaturation(base=-saturation, full=1.0 - saturation)
    usual = {"mask_tile": TILE, "mask_angle": 0.0}
    return Scene(foam=Foam(saturation=(source,), look=look, mask=mask, **usual | foam), light=None)


def looking_down(texels_a_pixel: float, side: int, x: float = 0.0, z: float = 0.0) -> Camera:
    height = 0.01 * texels_a_pixel * side / (2.0 * math.tan(0.5 * FOV))
    return Camera(position=(x, height, z), pitch=-math.pi / 2, fov=FOV)


def amounts(
    executor: Executor, scene: Scene, camera: Camera, size: tuple[int, int] = (192, 108), **quality: Any
) -> NDArray[np.float32]:
    """Foam amounts of pixels."""
    return linear(executor, scene, SQUARE.model_copy(update=quality), camera, size=size)[..., 3]


def coverage(executor: Executor, saturation: float, texels_a_pixel: float, side: int) -> NDArray[np.float32]:
    """Foam amounts, (side, side)."""
    return amounts(executor, flat(saturation), odd(texels_a_pixel, side), (side, side))


SATURATIONS = (0.03, 0.1, 0.25, 0.4, 0.55, 0.7, 0.9, 0.97)


@pytest.mark.parametrize(
    ("texels_a_pixel", "side", "bound"),
    [
        (2.0, 512, 0.001),
        (8.0, 256, 0.001),
        (16.0, 128, 0.001),
        (64.0, 128, 0.001),
        (0.5, 1024, 0.0015),
        (0.25, 2048, 0.001),
    ],
)
def test_mean_coverage_is_the_saturation(
    executor: Executor, report: Report, texels_a_pixel: float, side: int, bound: float
) -> None:
    """Over whole tiles, so that the mask itself has no say in the mean."""
    assert texels_a_pixel * side % 512 == 0
    saturations = SATURATIONS if texels_a_pixel >= 0.5 else (0.03, 0.4, 0.9)
    errors = [abs(float(coverage(executor, s, texels_a_pixel, side).mean(dtype=np.float64)) - s) for s in saturations]
    report.add(
        "Mean coverage of the filtered look against the saturation (vac-1.5)",
        texels_a_pixel=f"{texels_a_pixel:g}",
        worst=f"{max(errors):.5f}",
        bound=f"{bound:g}",
    )
    assert max(errors) <= bound


SCALES = {0.5: 1.5, 1.0: 2.5, 1.5: 2.5, 2.0: 2.5, 3.0: 2.0, 4.0: 2.0, 6.0: 1.0, 8.0: 1.0}
"""Texels a pixel, and how often the error of halftone at 16 samples the filtered look may have at one."""


def odd(texels_a_pixel: float, side: int) -> Camera:
    """Over an odd place, so that pixels do not sit on texels."""
    return looking_down(texels_a_pixel, side, x=0.0037, z=-1.2345)


@pytest.mark.parametrize("mask", ["vac-1.5", "vac-24"])
def test_filtered_once_against_halftone_sixteen_times_at_every_scale(
    executor: Executor, report: Report, mask: str
) -> None:
    """Root mean square error of coverage, each look against the mean of its own pixels of an eighth of a texel."""
    side = 32
    for texels_a_pixel, most in SCALES.items():
        camera = odd(texels_a_pixel, side)

        def amount(scene: Scene, parts: int, samples: int, camera: Camera = camera) -> NDArray[np.float64]:
            drawn = amounts(executor, scene, camera, (parts * side, parts * side), samples=samples).astype(np.float64)
            return drawn.reshape(side, parts, side, parts).mean(axis=(1, 3))

        errors = {}
        for look, samples in (("halftone", 16), ("filtered", 1)):
            off = []
            for saturation in (0.1, 0.3, 0.6):
                # Aligned with the texels, 16 samples would count two by two of them without an error.
                scene = flat(saturation, look, mask, mask_angle=0.5)
                limit = amount(scene, max(math.ceil(8.0 * texels_a_pixel), 8), 1)
                off.append(amount(scene, 1, samples) - limit)
            errors[look] = rms(np.array(off))
        report.add(
            "Coverage by scale: filtered once and halftone 16 times, each against its own limit",
            mask=mask,
            texels_a_pixel=f"{texels_a_pixel:g}",
            **{look: f"{error:.4f}" for look, error in errors.items()},
        )
        assert errors["filtered"] <= most * errors["halftone"], texels_a_pixel


def axis_aligned_share(picture: NDArray[np.float32]) -> float:
    """Share of the edges' strength whose direction is within 3 degrees of an axis; 1/15 where all are alike."""
    # Over a few pixels, so that the raster itself has no direction.
    dy, dx = np.gradient(ndimage.gaussian_filter(picture.astype(np.float64), 2.0))
    strength, angle = np.hypot(dx, dy), np.degrees(np.arctan2(dy, dx)) % 90.0
    return float(strength[(angle < 3.0) | (angle > 87.0)].sum() / strength.sum())


@pytest.mark.parametrize("mask", ["vac-24", "mix"])
def test_up_close_no_edge_is_square(executor: Executor, report: Report, mask: str) -> None:
    """A texel 48 pixels wide: the paper's look shows its squares, the filtered look round bubbles, antialiased."""
    camera = looking_down(1.0 / 48.0, 480, x=0.003, z=0.0071)
    square, smooth = (amounts(executor, flat(0.4, look, mask), camera, (480, 480)) for look in ("halftone", "filtered"))
    assert 0.0 < np.mean((smooth > 0.02) & (smooth < 0.98)) < 0.2
    assert axis_aligned_share(square) > 0.8
    title = "Edges along the texel grid, 48 pixels a texel (1/15 = no preference)"
    report.within(title, mask=mask, halftone=axis_aligned_share(square), filtered=(axis_aligned_share(smooth), 0.2))


def lace(saturation: float, octaves: int) -> Scene:
    return flat(saturation, mask="lace", mask_tile=20.0, octaves=octaves)


@pytest.mark.parametrize("height", [0.3, 1.0, 4.0, 15.0, 45.0, 200.0])
def test_flights_do_not_pop(executor: Executor, report: Report, height: float) -> None:
    """A millimetre toward the water and along it moves edges and nothing else, by as much as it moves the picture."""
    scene, (x, z) = lace(0.4, 4), (0.37, -0.21)
    start = Camera(position=(x, height, z), pitch=-math.pi / 2)
    before = amounts(executor, scene, start)
    # Pixels that the picture's corner and its middle move by.
    pixel = 2.0 * height * math.tan(0.5 * start.fov) / 108.0
    for way, place, moved in (
        ("toward", (x, height - 1e-3, z), 1e-3 / height * 0.5 * math.hypot(192.0, 108.0)),
        ("along", (x + 1e-3, height, z), 1e-3 / pixel),
    ):
        change = np.abs(amounts(executor, scene, start.model_copy(update={"position": place})) - before)
        # An edge between all and nothing that crosses a pixel changes it by as much as it moves; smoothed, twice that.
        report.within(
            "Foam amounts of frames 1 mm apart, level water, four octaves",
            height=height,
            way=way,
            pixels_moved=moved,
            largest=(change.max(), 2e-3 + 2.5 * moved),
        )


def test_foam_by_height_under_the_horizon(executor: Executor, report: Report) -> None:
    """Its mean in the rows under the horizon is that of 256 samples of the halftone look; off the mean height of a
    footprint it was thinner by 0.3."""
    limit = preset_amounts(executor, "paper-height", "halftone", 16, 4)
    once = preset_amounts(executor, "paper-height", "filtered", 1)
    # From the first row that lies under it whole: 15.6 degrees down, 48.7 high.
    rows = slice(11, 15)
    title = "Foam by height in the four rows under the horizon"
    report.within(title, truth=limit[rows].mean(), bias=(abs((once - limit)[rows].mean()), 0.06))


def preset_amounts(executor: Executor, name: str, look: Look, samples: int, parts: int = 1) -> NDArray[np.float64]:
    """Foam amounts of a preset, (54, 96), means over so many pixels by as many; without fade, texture and octaves."""
    scene = load_preset(name).scene
    plain = {"look": look, "fade": 0.0, "texture": 0.0, "octaves": 1}
    scene = scene.model_copy(update={"foam": scene.foam.model_copy(update=plain)})
    quality = SQUARE.model_copy(update={"samples": samples})
    drawn = linear(executor, scene, quality, time=2.7, size=(96 * parts, 54 * parts))[..., 3]
    return drawn.astype(np.float64).reshape(54, parts, 96, parts).mean(axis=(1, 3))
