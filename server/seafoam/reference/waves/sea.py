"""Sections 2 and 4: the open sea in float64, by numpy.fft on fine grids, cubic splines and Newton's method."""

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache, partial

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import map_coordinates, spline_filter

from seafoam.ocean.foam.whitecaps import AGE_STEP, AGE_STEPS, OLD_TEXELS, WhitecapModel, old_times, whitecap_model
from seafoam.ocean.waves.cascades import BAND, LEAST_JACOBIAN, LOOP, RAISED, Cascade, cascades
from seafoam.ocean.waves.stokes import foam_drift
from seafoam.reference.types import Bounds, Floats, Vec2
from seafoam.scene import Scene, Sea, WhitecapSaturation

TEXELS = 512  # texels along a tile: surface and slopes are bilinear between them, which is part of the model
NEWTON_STEPS = 12
coefficients = partial(spline_filter, order=3, mode="grid-wrap")
"""Coefficients of the periodic cubic B-spline through values."""


@dataclass(frozen=True)
class TileSample:
    """A tile at one time, at places (r,) of undisturbed water: height, displacement and their derivatives."""

    h: Floats
    h_x: Floats
    h_z: Floats
    d_x: Floats
    d_z: Floats
    xx: Floats
    xz: Floats
    zz: Floats

    def jacobian(self, choppiness: float) -> Floats:
        """det(1 + λ ∂D/∂x)."""
        return (1.0 + choppiness * self.xx) * (1.0 + choppiness * self.zz) - (choppiness * self.xz) ** 2


def amplitudes(cascade: Cascade, time: float) -> NDArray[np.complex128]:
    """h₀ e^{−iωt}, with ωt reduced in whole turns: exact at any time, s."""
    turns = math.fmod(time, LOOP) / LOOP
    angle = 2.0 * math.pi * np.mod(cascade.turns * turns, 1.0)
    result: NDArray[np.complex128] = cascade.h0 * np.exp(-1j * angle)
    return result


def grids(cascade: Cascade, time: float, texels: int, moved: Vec2 = (0.0, 0.0)) -> TileSample:
    """The field at texel corners x = j·size/texels, (texels, texels), row z, shifted by (x, z) m; by inverse FFT."""
    number = np.fft.fftfreq(texels, 1.0 / texels).round().astype(np.int64)
    spectrum = np.zeros((texels, texels), np.complex128)
    rows, columns = np.nonzero(cascade.h0)
    step = 2.0 * math.pi / cascade.size
    turned = np.exp(-1j * step * ((columns - BAND) * moved[0] + (rows - BAND) * moved[1]))
    spectrum[(rows - BAND) % texels, (columns - BAND) % texels] = amplitudes(cascade, time)[rows, columns] * turned
    kx, kz = step * number[None, :], step * number[:, None]
    k = np.maximum(np.hypot(kx, kz), 1e-300)
    factors = (np.ones_like(k), 1j * kx, 1j * kz, 1j * kx / k, 1j * kz / k, -kx * kx / k, -kx * kz / k, -kz * kz / k)
    # Each wave is stored once, at +k; the real part gives its half of the conjugate pair.
    return TileSample(*(2.0 * np.real(np.fft.ifft2(spectrum * factor)) * texels**2 for factor in factors))


@dataclass(frozen=True, eq=False)
class Tile:
    """A tile as a height field, at texel corners (texels, texels): heights about 0 and slopes."""

    size: float
    height: Floats
    h_x: Floats
    h_z: Floats
    fold: Floats  # λ div D
    label_x: Floats  # rest position of the water at each corner, texels
    label_z: Floats


def tile(cascade: Cascade, time: float, wanted: float, texels: int = TEXELS) -> Tile:
    """Converts a displaced tile to a height field: x + λD(x) = p solved for each corner p."""
    field = grids(cascade, time, texels)
    choppiness = cascade.choppiness(wanted)
    scale = choppiness * texels / cascade.size
    p_z, p_x = np.meshgrid(np.arange(texels, dtype=np.float64), np.arange(texels, dtype=np.float64), indexing="ij")
    splines = {name: coefficients(values) for name, values in vars(field).items()}

    def at(name: str, x: Floats, z: Floats) -> Floats:
        result: Floats = map_coordinates(splines[name], (z, x), order=3, mode="grid-wrap", prefilter=False)
        return result

    x, z = p_x.copy(), p_z.copy()
    for _ in range(NEWTON_STEPS if scale > 0.0 else 0):
        e_x, e_z = x + scale * at("d_x", x, z) - p_x, z + scale * at("d_z", x, z) - p_z
        a_xx, a_zz = 1.0 + choppiness * at("xx", x, z), 1.0 + choppiness * at("zz", x, z)
        a_xz = choppiness * at("xz", x, z)
        bounded = np.maximum(a_xx * a_zz - a_xz * a_xz, LEAST_JACOBIAN)
        x, z = x - (a_zz * e_x - a_xz * e_z) / bounded, z - (a_xx * e_z - a_xz * e_x) / bounded
        if max(np.abs(e_x).max(), np.abs(e_z).max()) < 1e-9:
            break
    rest = TileSample(*(at(name, x, z) for name in splines))
    bounded = np.maximum(rest.jacobian(choppiness), LEAST_JACOBIAN)
    a_xx, a_zz, a_xz = 1.0 + choppiness * rest.xx, 1.0 + choppiness * rest.zz, choppiness * rest.xz
    h_x, h_z = (a_zz * rest.h_x - a_xz * rest.h_z) / bounded, (a_xx * rest.h_z - a_xz * rest.h_x) / bounded
    length = np.hypot(h_x, h_z)
    kept = np.minimum(1.0, cascade.max_slope / np.maximum(length, 1e-300))
    height = np.clip(rest.h, -cascade.limit, cascade.limit)
    return Tile(cascade.size, height, h_x * kept, h_z * kept, a_xx + a_zz - 2.0, x, z)


@dataclass(frozen=True, eq=False)
class SeaSurface:
    """The open sea at one time around one origin: a part of the relief, with slopes and Jacobians."""

    tiles: tuple[Tile, ...]
    cascades: tuple[Cascade, ...]
    origin: Vec2
    earlier: tuple[tuple[Floats, ...], ...] = ()
    """For each raised tile, λ div D at each earlier time, moved with the water, if the scene has whitecaps; half the
    texels."""
    old: tuple[Floats, ...] = ()
    """The same for the largest tile at each older time, if the scene's foam lasts."""

    @cached_property
    def bounds(self) -> Bounds:
        """Slopes are between texels, and change over a texel's edge, where bilinear patches have kinks; the finest
        feature, half the shortest wave of the finest raised tile at ``TEXELS``, has 4 texels."""
        top, slope, curvature = sum(cascade.limit for cascade in self.cascades[:RAISED]), 0.0, 0.0
        for tile in self.tiles[:RAISED]:
            step = tile.size / tile.height.shape[0]
            before = [np.roll(tile.height, 1, axis) for axis in (0, 1)]
            across = (float(np.abs(tile.height - one).max()) for one in before)
            slope += math.hypot(*across) * tile.height.shape[0] / tile.size
            for axis in (0, 1):
                bend = before[axis] - 2.0 * tile.height + np.roll(tile.height, -1, axis)
                curvature += 2.0 * float(np.abs(bend).max()) / (step * step)
        finest = min(4.0 * tile.size / float(tile.height.shape[0]) for tile in self.tiles[:RAISED])
        return Bounds(top, -top, 1.001 * slope, curvature, finest)

    def height(self, x: Floats, z: Floats) -> Floats:
        return sum((self.read(1, tile, tile.height, x, z) for tile in self.tiles[:RAISED]), np.zeros_like(x))

    def gradient(self, x: Floats, z: Floats) -> Floats:
        return self._slopes(1, self.tiles[:RAISED], x, z)

    def shading(self, x: Floats, z: Floats) -> Floats:
        """Gradient of the raised tiles for shading; (2, r)."""
        return self._slopes(3, self.tiles[:RAISED], x, z)

    def detail(self, x: Floats, z: Floats) -> Floats:
        """Gradient of the tiles that change only the normals; (2, r)."""
        return self._slopes(3, self.tiles[RAISED:], x, z)

    def folds(self, x: Floats, z: Floats) -> list[Floats]:
        """λ div D now and at each earlier time, summed over the raised tiles; (r,) each."""
        now = 3, [tile.fold for tile in self.tiles[:RAISED]]
        return [
            np.sum([self.read(order, *one, x, z) for one in zip(self.tiles[:RAISED], parts, strict=True)], axis=0)
            for order, parts in (now, *((1, then) for then in zip(*self.earlier, strict=True)))
        ]

    def long_ago(self, model: WhitecapModel, x: Floats, z: Floats) -> Floats:
        """Remaining old foam; (r,), not limited to 1."""
        left = np.zeros_like(self.old[0])
        for share, folded in zip(model.old_shares, self.old, strict=True):
            left += share * np.clip((model.old[0] - folded) / model.old[1], 0.0, 1.0)
        return self.read(1, self.tiles[0], left, x, z)

    def to_rest(self, x: Floats, z: Floats) -> Floats:
        """Displacement from (x, z) to the rest position of the water there, m; (2, r)."""
        by = np.zeros((2, x.size))
        for tile in self.tiles[:RAISED]:
            texels = tile.label_x.shape[0]
            corner = np.arange(0, texels, 2)
            away = tile.label_x[::2, ::2] - corner[None, :], tile.label_z[::2, ::2] - corner[:, None]
            by += [self.read(1, tile, tile.size / texels * part, x, z) for part in away]
        return by

    def _slopes(self, order: int, tiles: tuple[Tile, ...], x: Floats, z: Floats) -> Floats:
        slope = np.zeros((2, x.size))
        for tile in tiles:
            slope += [self.read(order, tile, part, x, z) for part in (tile.h_x, tile.h_z)]
        return slope

    def read(self, order: int, tile: Tile, values: Floats, x: Floats, z: Floats) -> Floats:
        """``values`` of a tile at (x, z), m from the origin: bilinear, or as coefficients of a cubic B-spline."""
        at = [
            (math.fmod(start, tile.size) + place) * (values.shape[0] / tile.size)
            for start, place in zip(self.origin, (x, z), strict=True)
        ]
        result: Floats = map_coordinates(values, at[::-1], order=order, mode="grid-wrap", prefilter=False)
        return result


@lru_cache(maxsize=1)
def _tiles(sea: Sea, depth: float | None, time: float, texels: int) -> tuple[Tile, ...]:
    return tuple(tile(cascade, time, sea.choppiness, texels) for cascade in cascades(sea, depth))


@lru_cache(maxsize=1)
def _history(
    sea: Sea, depth: float | None, time: float, texels: int, drift: Vec2, lasting: bool
) -> tuple[tuple[tuple[Floats, ...], ...], tuple[Floats, ...]]:
    drawn, tiles = cascades(sea, depth), _tiles(sea, depth, time, texels)

    def then(cascade: Cascade, now: Tile, size: int, times: list[float]) -> tuple[Floats, ...]:
        """λ div D on ``size``² texels at earlier times, at every second texel, at the rest position of its water."""
        finer = texels // size
        place = now.label_z[::2, ::2] / finer, now.label_x[::2, ::2] / finer
        series = []
        for ago in times:
            field = grids(cascade, time - ago, size, (drift[0] * ago, drift[1] * ago))
            linear = cascade.choppiness(sea.choppiness) * (field.xx + field.zz)
            series.append(map_coordinates(linear, place, order=1, mode="grid-wrap"))
        return tuple(series)

    ages = [AGE_STEP * step for step in range(1, AGE_STEPS + 1)]
    earlier = tuple(then(cascade, now, texels // 2, ages) for cascade, now in zip(drawn[:RAISED], tiles, strict=False))
    old = then(drawn[0], tiles[0], OLD_TEXELS, old_times(AGE_STEPS, AGE_STEP)) if lasting else ()
    return earlier, old


def sea_surface(scene: Scene, time: float, origin: Vec2, texels: int = TEXELS) -> SeaSurface | None:
    """The scene's sea at a time (s) around an origin (x, z) in m, on tiles of ``texels``²; None without sea or wind."""
    if scene.sea is None or scene.sea.wind_speed <= 0.0:
        return None
    depth = scene.water.depth
    source = None if scene.foam is None else scene.foam.source(WhitecapSaturation)
    at = scene.sea, depth, time, texels
    past = () if source is None else _history(*at, foam_drift(scene), source.lasting)
    return SeaSurface(_tiles(*at), cascades(scene.sea, depth), origin, *past)


def whitecap_saturation(
    scene: Scene, foam: WhitecapSaturation, surface: SeaSurface | None, x: Floats, z: Floats
) -> Floats:
    """f at (x, z), m from the origin; (r,) in [0, 1]."""
    if scene.sea is None or surface is None:
        return np.zeros_like(x)
    model = whitecap_model(scene.sea, foam, scene.water.depth, AGE_STEPS, AGE_STEP, surface.tiles[0].fold.shape[0])
    if model is None:
        return np.zeros_like(x)
    total = np.zeros_like(x)
    for j, (share, folded) in enumerate(zip(model.shares, surface.folds(x, z), strict=True)):
        threshold, width = model.earlier if j else model.now
        total += share * np.clip((threshold - folded) / width, 0.0, 1.0)
    if model.old_shares:
        total += surface.long_ago(model, x, z)
    return np.minimum(total, 1.0)
