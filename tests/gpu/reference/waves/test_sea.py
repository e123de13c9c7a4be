"""The open sea: the GPU's tiles against float64 sums, its transform against numpy.fft, what a spectrum promises."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from gpu.reference.waves.test_parametric import between
from seafoam.effects.waves.sea import DISPLACED
from seafoam.framegraph.evaluation import FrameState, evaluate
from seafoam.ocean.foam import whitecaps as foam_of_sea
from seafoam.ocean.waves import cascades as sea_tiles
from seafoam.planner import FramePlan, make_plan
from seafoam.quality import TIERS
from seafoam.reference.renderer import camera as cameras
from seafoam.reference.renderer.frame import Assets, SampleShader
from seafoam.reference.waves import sea as truth
from seafoam.render.gl.executor import Executor
from support.exact import EXACT
from support.pictures import draw_target, linear, rms
from support.report import Report
from support.scenes import Camera, Sea, load_preset
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


def tile(executor: Executor, sea: Sea, time: float, name: str = "sea_tile_0", **quality: object) -> NDArray[np.float32]:
    """A tile of a sea without foam, as the GPU draws it."""
    plan = make_plan(seen(sea, foam=False), QUICK.model_copy(update=quality))
    return draw_target(executor, plan, name, time)


@pytest.mark.parametrize(("name", "time"), crossed(SEAS, TIMES, len(TIMES)))
def test_drawn_tiles_are_the_references(executor: Executor, report: Report, name: str, time: float) -> None:
    """The tiles that the GPU drew: each texel, and read as the shader reads them at 10,000 places round each origin."""
    scene = seen(SEAS[name])
    plan = make_plan(scene, EXACT)
    tiles = [draw_target(executor, plan, f"sea_tile_{i}", time) for i in range(sea_tiles.RAISED)]
    p = np.random.default_rng(7).uniform(-500.0, 500.0, (POINTS, 2)).astype(np.float32)
    origin_surface = truth.sea_surface(scene, time, (0.0, 0.0))
    _check_texels(executor, report, plan, origin_surface, name, time)
    for origin in ORIGINS:
        surface = truth.sea_surface(scene, time, origin)
        state = FrameState(time, Camera(position=(origin[0], 6.0, origin[1])), 16, 16, 16, 16)
        sums = np.zeros((POINTS, 4))
        for i, one in enumerate(tiles):
            offset, side = (evaluate(plan.uniforms[f"u_sea_{what}_{i}"], state) for what in ("offset", "size"))
            sums += bilinear(one, p / side[0] + offset)
        x, z = p.astype(np.float64).T
        slopes = np.stack(surface.gradient(x, z), axis=-1)
        # The place in the largest tile is a float32 share of it: good to a ten-thousandth of a texel.
        report.within(
            "Open sea at 10,000 places against float64: height in m, slope, normal in rad",
            model=name,
            time=time,
            origin=origin[0],
            height=(np.abs(sums[:, 0] - surface.height(x, z)).max(), 2e-3),
            slope=(np.abs(sums[:, 1:3] - slopes).max(), 2e-3),
            normal=(between(sums[:, 1:3], slopes), 2e-3),
        )


def blocks_of(layers: NDArray[np.float32]) -> Floats:
    """Blocks of water, (number, size, size, 4), of four layers over one another, each with a quarter of each block."""
    size = layers.shape[1]
    return layers.reshape(4, -1, size // 4, size, 4).swapaxes(0, 1).reshape(-1, size, size, 4).astype(np.float64)


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
    blocks = blocks_of(draw_target(executor, plan, DISPLACED, time))
    for i, one in enumerate(surface.tiles):
        moved = truth.grids(surface.cascades[i], time, truth.TEXELS)
        block = spline_at_texels(blocks[i][..., :3])
        got = draw_target(executor, plan, f"sea_tile_{i}", time).astype(np.float64)
        off = np.abs(got - np.stack((one.height, one.h_x, one.h_z, one.fold), -1)).max(axis=(0, 1))
        deviation = math.sqrt(surface.cascades[i].variance)
        report.within(
            "Tiles of open sea, 512 x 512 texels, against float64: displacement and height in m, slope, fold",
            model=name,
            time=time,
            tile=f"{one.size:g} m",
            displacement=(np.abs(block - np.stack((moved.h, moved.d_x, moved.d_z), -1)).max(), 1e-3 * deviation),
            height=(off[0], 1e-3 * deviation),
            slope=(off[1:3].max(), 1e-3),
            fold=(off[3], 1e-3),
        )
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
    sea, middle = SEAS["fft"], 2 * sea_tiles.BAND
    # Calm water that is filtered has no more than 256 texels.
    aliased = QUICK.surface.model_copy(update={"filter": False})
    blocks = blocks_of(tile(executor, sea, 12.5, DISPLACED, sea_size=size, sea_tiles=3, surface=aliased))
    response = (2.0 + np.cos(2.0 * math.pi * np.fft.fftfreq(size))) / 3.0
    number = np.fft.fftfreq(size, 1.0 / size).round().astype(int)
    held = np.flatnonzero(np.abs(number) < min(sea_tiles.BAND, size // 2))
    row, column = np.meshgrid(*(number[held] + sea_tiles.BAND,) * 2, indexing="ij")
    for i, of in enumerate(sea_tiles.cascades(sea, None)[:3]):
        block = blocks[i]
        spectrum = np.fft.fft2(block[..., 0]) / size**2 * response[:, None] * response[None, :]
        wanted = np.zeros((size, size), np.complex128)
        moved = truth.amplitudes(of, 12.5)
        wanted[np.ix_(held, held)] = moved[row, column] + np.conj(moved[middle - row, middle - column])
        scale = np.abs(wanted).max()
        parseval = float(np.mean(np.fft.ifft2(spectrum * size**2).real ** 2) / (np.abs(wanted) ** 2).sum())
        report.within(
            "The sea's transform on the GPU against numpy.fft, shares of the greatest amplitude",
            size=size,
            tile=f"{of.size:g} m",
            round_trip=(np.abs(spectrum - wanted).max() / scale, 3e-5),
            parseval=(abs(parseval - 1.0), 1e-4),
            imaginary=(np.abs(block[..., 3]).max() / np.abs(block[..., 2]).max(), 1e-5),
            mean=(abs(block[..., 0].mean()) / scale, 1e-6),
        )


def test_time_is_a_loop_of_whole_turns(executor: Executor) -> None:
    """The sea a whole loop later is the same; 1e9 s is as any other time."""
    first, later, other = (tile(executor, SEAS["fft"], time) for time in (11.0, 11.0 + 1000.0 * sea_tiles.LOOP, 11.1))
    assert np.array_equal(first, later)
    assert np.abs(first - other).max() > 1e-3


@pytest.mark.parametrize("preset", ["open-ocean", "boat-in-storm"])
def test_foam_lies_where_float64_has_it(executor: Executor, report: Report, preset: str) -> None:
    """At 400 pixels of the lower half of a picture 960 wide: coverage, against 16 samples a pixel in float64."""
    found = load_preset(preset)
    scene, (width, height), along = found.scene.settled, (960, 540), 4
    grid = cameras.SampleGrid(scene.camera, width, height, along)
    shader = SampleShader(scene, found.time, grid, "converged", Assets.for_scene(scene))
    random = np.random.default_rng(5)
    x, y = random.integers(0, width, 400), random.integers(height // 2, height, 400)
    offset = (np.indices((along, along))[..., None] + random.random((2, along, along, 400))) / along
    X, Y = 2.0 * (x + offset[1]) / width - 1.0, 1.0 - 2.0 * (y + offset[0]) / height
    _, amount = shader.shade(X.ravel(), Y.ravel())
    want = amount.reshape(-1, 400).mean(axis=0)
    coarse, fine = (
        rms(linear(executor, scene, quality, time=found.time, size=(width, height))[y, x, 3] - want)
        for quality in (TIERS["standard"].model_copy(update={"sea_size": size}) for size in (256, 512))
    )
    title = "Coverage by foam at pixels against float64, root mean square"
    report.within(title, preset=preset, tiles_of_256=coarse, of_512=(fine, min(0.1, 0.6 * coarse)))


@pytest.mark.parametrize("steps", [0, 4, 8])
def test_any_number_of_earlier_folds_can_be_drawn(executor: Executor, steps: int) -> None:
    """With none the program reads less of an array than it declares, and drivers shorten it."""
    quality = QUICK.model_copy(update={"age_steps": steps})
    assert np.isfinite(linear(executor, seen(SEAS["fft"]), quality, time=1.0, size=(32, 18))).all()
