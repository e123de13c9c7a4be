"""The open sea: the GPU's tiles against float64 sums, its transform against numpy.fft, what a spectrum promises."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.effects.waves.sea import DISPLACED
from seafoam.framegraph.evaluation import FrameState, evaluate
from seafoam.ocean.basics import spectrum as sea_spectrum
from seafoam.ocean.foam import whitecaps as foam_of_sea
from seafoam.ocean.waves import cascades as sea_tiles
from seafoam.planner import FramePlan, make_plan
from seafoam.quality import TIERS
from seafoam.reference.renderer import camera as cameras
from seafoam.reference.renderer.frame import Assets, SampleShader
from seafoam.reference.waves import sea as truth
from seafoam.render.gl.executor import Executor
from support.exact import EXACT
from support.float64.tile import summed
from support.pictures import draw, draw_target
from support.report import Report
from support.scenes import Camera, Foam, Scene, Sea, WhitecapSaturation, load_preset
from support.scenes.seas import SEAS, seen
from support.sweep import crossed

Floats = NDArray[np.float64]

TIMES = (0.0, 12.5, 3600.0, 1e9)
ORIGINS = ((0.0, 0.0), (1e7, -1e7))
QUICK = TIERS["standard"].model_copy(update={"sea_digits": "float"})
POINTS = 10_000


def bilinear(tile: NDArray[np.float32], at: NDArray[np.float32]) -> NDArray[np.float32]:
    """``sea_fetch`` of the shader, in float32. at: (r, 2), in tiles."""
    size = tile.shape[0]
    place = (at - np.floor(at)) * np.float32(size)
    base = np.floor(place)
    t = (place - base)[:, :, None]
    near = base.astype(np.int64) % size
    far = (near + 1) % size
    first = tile[near[:, 1], near[:, 0]] * (1 - t[:, 0]) + tile[near[:, 1], far[:, 0]] * t[:, 0]
    second = tile[far[:, 1], near[:, 0]] * (1 - t[:, 0]) + tile[far[:, 1], far[:, 0]] * t[:, 0]
    return first * (1 - t[:, 1]) + second * t[:, 1]


@pytest.mark.parametrize(("name", "time"), crossed(SEAS, TIMES, len(TIMES)))
def test_drawn_tiles_are_the_references(executor: Executor, report: Report, name: str, time: float) -> None:
    """The tiles that the GPU drew: each texel, and read as the shader reads them at 10,000 places round each origin."""
    scene = seen(SEAS[name])
    plan = make_plan(scene, EXACT)
    tiles = [draw_target(executor, plan, f"sea_tile_{i}", time) for i in range(sea_tiles.RAISED)]
    random = np.random.default_rng(7)
    p = random.uniform(-500.0, 500.0, (POINTS, 2)).astype(np.float32)
    origin_surface = truth.sea_surface(scene, time, (0.0, 0.0))
    assert origin_surface is not None
    _check_texels(executor, report, plan, origin_surface, name, time)
    for origin in ORIGINS:
        surface = truth.sea_surface(scene, time, origin)
        assert surface is not None
        camera = Camera(position=(origin[0], 6.0, origin[1]))
        state = FrameState(time, camera, 16, 16, 16, 16, 0)
        offsets = [evaluate(plan.uniforms[f"u_sea_offset_{i}"], state) for i in range(sea_tiles.RAISED)]
        sides = [evaluate(plan.uniforms[f"u_sea_size_{i}"], state)[0] for i in range(sea_tiles.RAISED)]
        sums = np.zeros((POINTS, 4))
        for tile, offset, side in zip(tiles, offsets, sides, strict=True):
            sums += bilinear(tile, p / side + offset)
        x, z = p.astype(np.float64).T
        h_x, h_z = surface.gradient(x, z)
        away = {
            "height": np.abs(sums[:, 0] - surface.height(x, z)).max(),
            "slope": max(np.abs(sums[:, 1] - h_x).max(), np.abs(sums[:, 2] - h_z).max()),
            "normal": _angle(sums[:, 1], sums[:, 2], h_x, h_z).max(),
        }
        report.add(
            "Open sea at 10,000 places against float64: greatest difference",
            model=name,
            time=f"{time:g} s",
            origin=f"{origin[0]:g} m",
            height=f"{1e3 * away['height']:.4f} mm",
            slope=f"{away['slope']:.1e}",
            normal=f"{away['normal']:.1e} rad",
        )
        # The place in the largest tile is a float32 share of it: good to a ten-thousandth of a texel.
        assert away["height"] <= 2e-3
        assert away["slope"] <= 2e-3
        assert away["normal"] <= 2e-3


def _angle(a_x: Floats, a_z: Floats, b_x: Floats, b_z: Floats) -> Floats:
    dot = (a_x * b_x + a_z * b_z + 1.0) / np.sqrt((a_x**2 + a_z**2 + 1.0) * (b_x**2 + b_z**2 + 1.0))
    cross = np.sqrt((a_x - b_x) ** 2 + (a_z - b_z) ** 2 + (a_x * b_z - a_z * b_x) ** 2)
    return np.arctan2(cross, dot * np.sqrt((a_x**2 + a_z**2 + 1.0) * (b_x**2 + b_z**2 + 1.0)))


def spline_at_texels(coefficients: Floats) -> Floats:
    """Values at the texels of the uniform cubic B-spline with these coefficients, periodic; (size, size, n)."""
    for axis in (0, 1):
        beside = np.roll(coefficients, 1, axis) + np.roll(coefficients, -1, axis)
        coefficients = (beside + 4.0 * coefficients) / 6.0
    return coefficients


def _check_texels(
    executor: Executor, report: Report, plan: FramePlan, surface: truth.SeaSurface, name: str, time: float
) -> None:
    """Every texel of every tile that the GPU drew: displacement, height, slopes, fold, and folds of earlier times."""
    atlas = draw_target(executor, plan, DISPLACED, time).astype(np.float64)
    for i, one in enumerate(surface.tiles):
        moved = truth.grids(surface.cascades[i], time, truth.TEXELS)
        block = spline_at_texels(atlas[:, i * truth.TEXELS : (i + 1) * truth.TEXELS, :3])
        shift = np.abs(block - np.stack((moved.h, moved.d_x, moved.d_z), -1)).max()
        got = draw_target(executor, plan, f"sea_tile_{i}", time).astype(np.float64)
        away = [np.abs(got[..., 0] - one.height).max(), np.abs(got[..., 1:3] - np.stack((one.h_x, one.h_z), -1)).max()]
        fold = np.abs(got[..., 3] - one.fold).max()
        report.add(
            "Tiles of open sea, 512 x 512 texels, against float64: greatest difference",
            model=name,
            time=f"{time:g} s",
            tile=f"{one.size:g} m",
            displacement=f"{1e3 * shift:.4f} mm",
            height=f"{1e3 * away[0]:.4f} mm",
            slope=f"{away[1]:.1e}",
            fold=f"{fold:.1e}",
        )
        assert shift <= 1e-3 * math.sqrt(surface.cascades[i].variance)
        assert away[0] <= 1e-3 * math.sqrt(surface.cascades[i].variance)
        assert away[1] <= 1e-3
        assert fold <= 1e-3
    drawn = draw_target(executor, plan, "age_tiles", time).astype(np.float64)
    side, rows = drawn.shape[1], foam_of_sea.AGE_STEPS // 4
    for i, then in enumerate(surface.earlier):
        for row in range(rows):
            got = drawn[(i * rows + row) * (side + 1) :][: side + 1]
            assert np.abs(got[:-1] - np.stack(then[4 * row : 4 * row + 4], -1)).max() <= 1e-3
            assert (got[-1] == got[0]).all()


@pytest.mark.parametrize("size", [64, 128, 256, 512])
def test_the_transform_is_numpys(executor: Executor, report: Report, size: int) -> None:
    """Round trip, Parseval, Hermitian symmetry (real fields) and zero mean of what the passes made."""
    sea = SEAS["fft"]
    quality = QUICK.model_copy(update={"sea_size": size, "sea_tiles": 3})
    plan = make_plan(seen(sea, foam=False), quality)
    atlas = draw_target(executor, plan, DISPLACED, 12.5).astype(np.float64)
    response = (2.0 + np.cos(2.0 * math.pi * np.fft.fftfreq(size))) / 3.0
    for i, of in enumerate(sea_tiles.cascades(sea, None)[:3]):
        block = atlas[:, i * size : (i + 1) * size]
        spectrum = np.fft.fft2(block[..., 0]) / size**2 * response[:, None] * response[None, :]
        number = np.fft.fftfreq(size, 1.0 / size).round().astype(int)
        wanted = np.zeros((size, size), np.complex128)
        moved = truth.amplitudes(of, 12.5)
        for j, iz in enumerate(number):
            for m, ix in enumerate(number):
                if max(abs(ix), abs(iz)) < min(sea_tiles.BAND, size // 2):
                    row, column = iz + sea_tiles.BAND, ix + sea_tiles.BAND
                    middle = 2 * sea_tiles.BAND
                    wanted[j, m] = moved[row, column] + np.conj(moved[middle - row, middle - column])
        scale = np.abs(wanted).max()
        parseval = float(np.mean(np.fft.ifft2(spectrum * size**2).real ** 2) / (np.abs(wanted) ** 2).sum())
        report.add(
            "The sea's transform on the GPU against numpy.fft, shares of the greatest amplitude",
            size=str(size),
            tile=f"{of.size:g} m",
            round_trip=f"{np.abs(spectrum - wanted).max() / scale:.1e}",
            parseval=f"{parseval - 1:.1e}",
            imaginary=f"{np.abs(block[..., 3]).max() / np.abs(block[..., 2]).max():.1e}",
            mean=f"{abs(block[..., 0].mean()) / scale:.1e}",
        )
        assert np.abs(spectrum - wanted).max() <= 3e-5 * scale
        assert abs(parseval - 1.0) <= 1e-4
        assert np.abs(block[..., 3]).max() <= 1e-5 * np.abs(block[..., 2]).max()
        assert abs(block[..., 0].mean()) <= 1e-6 * scale


@pytest.mark.parametrize("wind", [4.0, 10.0, 22.0, 60.0])
@pytest.mark.parametrize("name", SEAS)
def test_significant_height(executor: Executor, report: Report, wind: float, name: str) -> None:
    """From the spectrum, from the waves, and from the field that is drawn: within 2 %."""
    sea = SEAS[name].model_copy(update={"wind": wind, "fetch": 5e5})
    omega = np.geomspace(0.3, 60.0, 20001) * sea_spectrum.peak_frequency(wind, sea.fetch)
    wanted = 4.0 * math.sqrt(np.trapezoid(sea_spectrum.frequency_spectrum(omega, wind, sea.fetch), omega))
    drawn = sea_tiles.cascades(sea, None)
    waves = 4.0 * math.sqrt(sum(of.variance for of in drawn))
    quality = QUICK.model_copy(update={"sea_size": 128})
    calm = sea.model_copy(update={"choppiness": 0.0})
    plan = make_plan(seen(calm, foam=False), quality)
    tiles = [draw_target(executor, plan, f"sea_tile_{i}", 31.0).astype(np.float64) for i in range(len(drawn))]
    field = 4.0 * math.sqrt(sum(float(np.mean(tile[..., 0] ** 2)) for tile in tiles))
    report.add(
        "Significant wave height, m",
        model=name,
        wind=f"{wind:g} m/s",
        spectrum=f"{wanted:.4f}",
        waves=f"{waves:.4f}",
        field=f"{field:.4f}",
    )
    assert abs(waves / wanted - 1.0) <= 0.02
    assert abs(field / wanted - 1.0) <= 0.02


@pytest.mark.parametrize("name", SEAS)
def test_without_choppiness_nothing_folds(executor: Executor, name: str) -> None:
    calm = SEAS[name].model_copy(update={"choppiness": 0.0})
    tile = draw_target(executor, make_plan(seen(calm, foam=False), QUICK), "sea_tile_0", 5.0)
    assert np.abs(tile[..., 3]).max() == 0.0
    assert np.abs(tile[..., 0]).max() > 0.1


@pytest.mark.parametrize("name", SEAS)
def test_a_tile_has_no_seam(executor: Executor, name: str) -> None:
    """Across its edge a tile changes as it does inside; and its waves are the same a whole tile away."""
    tile = draw_target(executor, make_plan(seen(SEAS[name], foam=False), QUICK), "sea_tile_0", 5.0)
    tile = tile[..., :3].astype(np.float64)
    for axis in (0, 1):
        inside = np.abs(np.diff(tile, axis=axis)).reshape(-1, 3)
        edge = np.abs(np.take(tile, 0, axis) - np.take(tile, -1, axis)).reshape(-1, 3)
        assert (edge.max(axis=0) <= inside.max(axis=0)).all()
        assert (edge.mean(axis=0) <= 2.0 * inside.mean(axis=0)).all()
    of = sea_tiles.cascades(SEAS[name], None)[0]
    x = np.linspace(0.0, of.size, 50)
    here, there = summed(of, 5.0, x, 0.3 * x), summed(of, 5.0, x + of.size, 0.3 * x - of.size)
    assert np.abs(here.h - there.h).max() <= 1e-9


def test_dc_and_nyquist_are_empty(executor: Executor) -> None:
    for of in sea_tiles.cascades(Sea(wind=60.0, fetch=1e7), None):
        assert of.h0[sea_tiles.BAND, sea_tiles.BAND] == 0.0
        assert not of.h0[0].any()
        assert not of.h0[:, 0].any()
    quality = QUICK.model_copy(update={"sea_size": 64})
    plan = make_plan(seen(SEAS["fft"], foam=False), quality)
    atlas = draw_target(executor, plan, "sea_a", 5.0)
    assert np.isfinite(atlas).all()


def test_time_is_a_loop_of_whole_turns(executor: Executor) -> None:
    """The sea a whole loop later is the same; 1e9 s is as any other time."""
    plan = make_plan(seen(SEAS["fft"], foam=False), QUICK)
    first = draw_target(executor, plan, "sea_tile_0", 11.0)
    later = draw_target(executor, plan, "sea_tile_0", 11.0 + 1000.0 * sea_tiles.LOOP)
    assert np.array_equal(first, later)
    other = draw_target(executor, plan, "sea_tile_0", 11.1)
    assert np.abs(first - other).max() > 1e-3


@pytest.mark.parametrize("look", ["halftone", "filtered"])
def test_whitecaps_counted_in_a_picture(executor: Executor, report: Report, look: str) -> None:
    """From above, one sample a pixel: the drawn foam covers what the closed form says."""
    wind = 15.0
    foam = Foam(saturation=(WhitecapSaturation(),), look=look)  # type: ignore[arg-type]
    scene = Scene(sea=Sea(wind=wind, fetch=5e5), foam=foam, light=None)
    shares = []
    for height, size in ((300.0, (360, 360)), (4000.0, (240, 240))):
        camera = Camera(position=(0.0, height, 0.0), pitch=-math.pi / 2, fov=1.0)
        for time in (0.0, 333.0, 777.0):
            plan = make_plan(scene, TIERS["standard"])
            frame = draw(executor, plan, camera, time=time, size=size, output="linear")
            shares.append(float(frame[..., 3].mean()))
    wanted = 3.84e-6 * wind**3.41
    report.add(
        "Whitecaps counted in pictures from above, 15 m/s",
        look=look,
        wanted=f"{100 * wanted:.2f} %",
        from_300_m=f"{100 * np.mean(shares[:3]):.2f} %",
        from_4_km=f"{100 * np.mean(shares[3:]):.2f} %",
    )
    assert abs(np.mean(shares[3:]) / wanted - 1.0) <= 0.2
    assert abs(np.mean(shares[:3]) / wanted - 1.0) <= 0.2


@pytest.mark.parametrize("preset", ["open-ocean", "boat-in-storm"])
def test_foam_lies_where_float64_has_it(executor: Executor, report: Report, preset: str) -> None:
    """At 400 pixels of the lower half of a picture 960 wide: coverage, against 16 samples a pixel in float64."""
    found = load_preset(preset)
    scene, (width, height), along = found.scene.settled, (960, 540), 4
    grid = cameras.SampleGrid(cameras.view(scene.camera, width, height), width, height, along)
    shader = SampleShader(scene, found.time, grid, "converged", Assets.for_scene(scene))
    random = np.random.default_rng(5)
    x, y = random.integers(0, width, 400), random.integers(height // 2, height, 400)
    offset = (np.indices((along, along))[..., None] + random.random((2, along, along, 400))) / along
    X, Y = 2.0 * (x + offset[1]) / width - 1.0, 1.0 - 2.0 * (y + offset[0]) / height
    _, amount, _ = shader.shade(X.ravel(), Y.ravel())
    want = amount.reshape(-1, 400).mean(axis=0)
    away = {}
    for size in (256, 512):
        plan = make_plan(scene, TIERS["standard"].model_copy(update={"sea_size": size}))
        frame = draw(executor, plan, scene.camera, time=found.time, size=(width, height), output="linear")
        away[size] = float(np.sqrt(np.mean((frame[y, x, 3] - want) ** 2)))
    report.add(
        "Coverage by foam at pixels against float64, root mean square",
        preset=preset,
        tiles_of_256=f"{away[256]:.3f}",
        of_512=f"{away[512]:.3f}",
    )
    assert away[512] <= 0.1
    assert away[512] <= 0.6 * away[256]


@pytest.mark.parametrize("steps", [0, 4, 8])
def test_any_number_of_earlier_folds_can_be_drawn(executor: Executor, steps: int) -> None:
    """With none the program reads less of an array than it declares, and drivers shorten it."""
    plan = make_plan(seen(SEAS["fft"]), QUICK.model_copy(update={"age_steps": steps}))
    frame = draw(executor, plan, Camera(), time=1.0, size=(32, 18), output="linear")
    assert np.isfinite(frame).all()
