"""The filtered look: right coverage at every scale, round edges up close, no shimmer far away (docs/formulae.md, 5)."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import ndimage
from scipy.ndimage import gaussian_filter

from seafoam.planner import make_plan
from seafoam.quality import TIERS, Quality
from seafoam.render.gl.executor import Executor
from support.pictures import colours, draw
from support.report import Report
from support.scenes import Camera, Foam, HeightSaturation, Look, Scene, load_preset
from support.sweep import spread

TILE = 5.12
"""512 texels of 1 cm."""
FOV = 0.02
"""So narrow that every pixel has the same footprint to 10⁻⁴."""


def flat(saturation: float, look: Look = "filtered", mask: str = "vac-1.5") -> Scene:
    """Unlit flat water, the same saturation everywhere: at height 0 (H − H0)/(Hmax − H0) is −H0 for Hmax = 1 + H0."""
    source = HeightSaturation(base=-saturation, full=1.0 - saturation)
    return Scene(foam=Foam(saturation=(source,), look=look, mask=mask, mask_tile=TILE, mask_angle=0.0), light=None)


def looking_down(texels_a_pixel: float, side: int, x: float = 0.0, z: float = 0.0) -> Camera:
    height = 0.01 * texels_a_pixel * side / (2.0 * math.tan(0.5 * FOV))
    return Camera(position=(x, height, z), pitch=-math.pi / 2, fov=FOV)


def coverage(
    executor: Executor, saturation: float, texels_a_pixel: float, side: int, *, quality: Quality = TIERS["standard"]
) -> NDArray[np.float32]:
    """Foam amounts, (side, side)."""
    # An odd place, so that pixels do not sit on texels.
    camera = looking_down(texels_a_pixel, side, x=0.0037, z=-1.2345)
    plan = make_plan(flat(saturation), quality)
    return draw(executor, plan, camera, time=0.0, size=(side, side), output="linear")[..., 3]


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


@pytest.mark.parametrize("texels_a_pixel", [0.01, 0.3, 0.7, 1.0, 2.0, 8.0, 100.0])
def test_none_at_0_and_all_at_1(executor: Executor, texels_a_pixel: float) -> None:
    assert (coverage(executor, 0.0, texels_a_pixel, 128) == 0.0).all()
    assert (coverage(executor, 1.0, texels_a_pixel, 128) == 1.0).all()


SCALES = {0.5: 1.5, 1.0: 2.5, 1.5: 2.5, 2.0: 2.5, 3.0: 2.0, 4.0: 2.0, 6.0: 1.0, 8.0: 1.0}
"""Texels a pixel, and how often the error of halftone at 16 samples the filtered look may have at one."""


@pytest.mark.parametrize("mask", ["vac-1.5", "vac-24"])
def test_filtered_once_against_halftone_sixteen_times_at_every_scale(
    executor: Executor, report: Report, mask: str
) -> None:
    """Root mean square error of coverage, each look against the mean of its own pixels of an eighth of a texel."""
    side = 32
    for texels_a_pixel, most in SCALES.items():
        errors = {}
        for look, samples in (("halftone", 16), ("filtered", 1)):
            squares = []
            for saturation in (0.1, 0.3, 0.6):
                scene = flat(saturation, look, mask)  # type: ignore[arg-type]
                assert scene.foam is not None
                # Aligned with the texels, 16 samples would count two by two of them without an error.
                scene = scene.model_copy(update={"foam": scene.foam.model_copy(update={"mask_angle": 0.5})})
                camera = looking_down(texels_a_pixel, side, x=0.0037, z=-1.2345)

                def amount(parts: int, quality: Quality, scene: Scene = scene, camera: Camera = camera):  # type: ignore[no-untyped-def]
                    plan = make_plan(scene, quality)
                    size = parts * side
                    drawn = draw(executor, plan, camera, time=0.0, size=(size, size), output="linear")
                    return drawn[..., 3].astype(np.float64).reshape(side, parts, side, parts).mean(axis=(1, 3))

                quality = TIERS["standard"]
                limit = amount(max(math.ceil(8.0 * texels_a_pixel), 8), quality)
                squares.append((amount(1, quality.model_copy(update={"samples": samples})) - limit) ** 2)
            errors[look] = float(np.sqrt(np.mean(squares)))
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
    smooth = gaussian_filter(picture.astype(np.float64), 2.0)
    dy, dx = np.gradient(smooth)
    strength = np.hypot(dx, dy)
    angle = np.degrees(np.arctan2(dy, dx)) % 90.0
    aligned = (angle < 3.0) | (angle > 87.0)
    return float(strength[aligned].sum() / strength.sum())


@pytest.mark.parametrize("mask", ["vac-24", "mix"])
def test_up_close_no_edge_is_square(executor: Executor, report: Report, mask: str) -> None:
    """A texel 48 pixels wide: the paper's look shows its squares, the filtered look round bubbles, antialiased."""
    side = 480
    shares = {}
    for look in ("halftone", "filtered"):
        plan = make_plan(flat(0.4, look, mask), TIERS["standard"])
        camera = looking_down(1.0 / 48.0, side, x=0.003, z=0.0071)
        picture = draw(executor, plan, camera, time=0.0, size=(side, side), output="linear")[..., 3]
        shares[look] = axis_aligned_share(picture)  # type: ignore[arg-type]
        if look == "filtered":
            soft = np.mean((picture > 0.02) & (picture < 0.98))
            assert 0.0 < soft < 0.2
    report.add(
        "Edges along the texel grid, 48 pixels a texel (1/15 = no preference)",
        mask=mask,
        **{look: f"{share:.3f}" for look, share in shares.items()},
    )
    assert shares["halftone"] > 0.8
    assert shares["filtered"] < 0.2


def shimmer(executor: Executor, look: Look) -> float:
    """How much more a far pixel changes at one sample than at 64 while the camera turns a third of a pixel; levels.

    Time is frozen. Rows from the horizon to 8 degrees below it.
    """
    preset = load_preset("paper-halftone")
    assert preset.scene.foam is not None
    scene = preset.scene.model_copy(update={"foam": preset.scene.foam.model_copy(update={"look": look})})
    width, height = 320, 180
    step = scene.camera.fov / height / 3.0
    changes = {}
    for samples in (1, 64):
        plan = make_plan(scene, TIERS["standard"].model_copy(update={"samples": samples}))
        frames = []
        for turn in range(4):
            camera = scene.camera.model_copy(update={"yaw": scene.camera.yaw + turn * step})
            frame = draw(executor, plan, camera, time=preset.time, size=(width, height), output="linear")
            frames.append(colours(frame))
        changes[samples] = np.diff(np.stack(frames), axis=0)
    rows = np.arange(height)
    up = np.tan(scene.camera.fov / 2) * (1.0 - 2.0 * (rows + 0.5) / height)
    depression = -(scene.camera.pitch + np.arctan(up))
    far = (depression > 0.0) & (depression < math.radians(8.0))
    return float(np.abs(changes[1] - changes[64])[:, far].mean() * 255.0)


def test_the_horizon_does_not_shimmer(executor: Executor, report: Report) -> None:
    measured = {look: shimmer(executor, look) for look in ("halftone", "filtered")}  # type: ignore[arg-type]
    report.add(
        "Shimmer within 8° of the horizon: change a frame beyond that of 64 samples, levels of linear light",
        **{look: f"{value:.2f}" for look, value in measured.items()},
    )
    assert measured["filtered"] <= 0.5 * measured["halftone"]


def test_filtered_thickens_with_saturation(executor: Executor) -> None:
    means = [float(coverage(executor, s, 4.0, 128).mean()) for s in (0.1, 0.3, 0.5, 0.7)]
    assert means == sorted(means)


def lace(saturation: float, octaves: int) -> Scene:
    scene = flat(saturation, mask="lace")
    assert scene.foam is not None
    return scene.model_copy(update={"foam": scene.foam.model_copy(update={"mask_tile": 20.0, "octaves": octaves})})


def amounts(
    executor: Executor, scene: Scene, camera: Camera, size: tuple[int, int] = (192, 108)
) -> NDArray[np.float32]:
    return draw(executor, make_plan(scene, TIERS["standard"]), camera, time=0.0, size=size, output="linear")[..., 3]


@pytest.mark.parametrize("height", [0.3, 1.0, 4.0, 15.0, 45.0, 200.0])
def test_flights_do_not_pop(executor: Executor, report: Report, height: float) -> None:
    """A millimetre toward the water and along it moves edges and nothing else, by as much as it moves the picture."""
    scene = lace(0.4, 4)
    start = Camera(position=(0.37, height, -0.21), pitch=-math.pi / 2)
    before = amounts(executor, scene, start)
    # Pixels that the picture's corner and its middle move by.
    pixel = 2.0 * height * math.tan(0.5 * start.fov) / 108.0
    moved = {"toward": 1e-3 / height * 0.5 * math.hypot(192.0, 108.0), "along": 1e-3 / pixel}
    for way, step in (("toward", (0.0, -1e-3, 0.0)), ("along", (1e-3, 0.0, 0.0))):
        x, y, z = start.position
        camera = start.model_copy(update={"position": (x + step[0], y + step[1], z + step[2])})
        change = np.abs(amounts(executor, scene, camera) - before)
        report.add(
            "Foam amounts of frames 1 mm apart, level water, four octaves",
            height=f"{height:g} m",
            way=way,
            moved=f"{moved[way]:.4f} pixels",
            largest=f"{change.max():.4f}",
            mean=f"{change.mean():.5f}",
        )
        # An edge between all and nothing that crosses a pixel changes it by as much as it moves; smoothed, twice that.
        assert change.max() <= 2e-3 + 2.5 * moved[way]


@pytest.mark.parametrize("height", [2.0, 6.0, 20.0, 45.0])
def test_a_metre_nearer_resolves_only_grey(executor: Executor, height: float) -> None:
    """What was whole foam or clear water in a pixel and those round it still is; the cover of it all stays."""
    scene = lace(0.4, 4)
    side = 240
    far = Camera(position=(0.37, height, -0.21), pitch=-math.pi / 2, fov=0.5)
    nearer = far.model_copy(update={"position": (0.37, height - 1.0, -0.21)})
    before, after = (amounts(executor, scene, camera, (side, side)) for camera in (far, nearer))
    # Where pixels of the nearer picture are in the far one.
    middle = 0.5 * (side - 1.0)
    place = np.rint(middle + (np.arange(side) - middle) * (height - 1.0) / height).astype(int)
    rows, columns = np.ix_(place, place)
    whole, clear = (
        ndimage.minimum_filter(test, 3, mode="constant", cval=False)[rows, columns]
        for test in (before > 0.999, before < 0.001)
    )
    assert whole.sum() > 20
    assert clear.sum() > 1000
    # A texel of a level says where its thresholds lie by two numbers, so specks in it are not seen from far.
    for off in (1.0 - after[whole], after[clear]):
        assert np.quantile(off, 0.995) < 0.01
        assert off.max() < 0.15
    assert after.mean() == pytest.approx(before[rows, columns].mean(), abs=0.01)


def preset_amounts(executor: Executor, name: str, look: Look, samples: int, parts: int = 1) -> NDArray[np.float64]:
    """Foam amounts of a preset, (54, 96), means over so many pixels by as many; without fade, texture and octaves."""
    preset = load_preset(name)
    assert preset.scene.foam is not None
    plain = {"look": look, "fade": 0.0, "texture": 0.0, "octaves": 1}
    scene = preset.scene.model_copy(update={"foam": preset.scene.foam.model_copy(update=plain)})
    plan = make_plan(scene, TIERS["standard"].model_copy(update={"samples": samples}))
    drawn = draw(executor, plan, scene.camera, time=2.7, size=(96 * parts, 54 * parts), output="linear")[..., 3]
    return drawn.astype(np.float64).reshape(54, parts, 96, parts).mean(axis=(1, 3))


HELD = ("swell", "boat-race", "drift-vortices", "murky-estuary")
"""Presets beside those of the paper in which the filtered look has no more error once than halftone at 16 samples."""


@pytest.mark.parametrize("name", spread(HELD, 2))
def test_filtered_once_against_halftone_sixteen_times_in_presets(executor: Executor, report: Report, name: str) -> None:
    """Root mean square error of coverage, each look against 256 samples a pixel."""
    errors = {}
    for look, samples in (("halftone", 16), ("filtered", 1)):
        limit = preset_amounts(executor, name, look, 16, 4)  # type: ignore[arg-type]
        errors[look] = float(np.sqrt(((preset_amounts(executor, name, look, samples) - limit) ** 2).mean()))  # type: ignore[arg-type]
    report.add(
        "Coverage in presets: filtered once and halftone 16 times, each against its own limit",
        preset=name,
        **{look: f"{error:.4f}" for look, error in errors.items()},
    )
    assert errors["filtered"] <= errors["halftone"]


def test_foam_by_height_under_the_horizon(executor: Executor, report: Report) -> None:
    """Its mean in the rows under the horizon is that of 256 samples of the halftone look; off the mean height of a
    footprint it was thinner by 0.3."""
    limit = preset_amounts(executor, "paper-height", "halftone", 16, 4)
    once = preset_amounts(executor, "paper-height", "filtered", 1)
    # From the first row that lies under it whole: 15.6 degrees down, 48.7 high.
    rows = slice(11, 15)
    bias = float((once - limit)[rows].mean())
    report.add(
        "Foam by height in the four rows under the horizon", truth=f"{limit[rows].mean():.3f}", bias=f"{bias:+.3f}"
    )
    assert abs(bias) <= 0.06
