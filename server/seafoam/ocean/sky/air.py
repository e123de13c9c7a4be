"""Light that a clear atmosphere scatters, integrated over a round earth. docs/formulae.md, section 9.

Rayleigh and Mie scattering and the absorption of ozone at 660, 545 and 445 nm for red, green and blue, single
scattering along each view ray, and all further orders as of an isotropic medium (Hillaire 2020, "A Scalable and
Production Ready Sky and Atmosphere Rendering Technique"). Scattering by molecules is Bruneton and Neyret's (2008) by
the inverse fourth power of the wavelength; the layer of ozone is Bruneton's (2017). Lengths are km, and radiances are
per unit of irradiance above the atmosphere.
"""

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from seafoam.ocean.arrays import Floats, smoothstep

EARTH, TOP = 6360.0, 6460.0
"""Radius of the ground and of the end of the atmosphere, km."""
RAYLEIGH = np.array([6.54e-3, 14.05e-3, 31.6e-3])
"""Scattering by molecules at the ground, 1/km."""
OZONE = np.array([1.15e-3, 1.72e-3, 0.08e-3])
"""Absorption by ozone at 25 km (Chappuis band), 1/km."""
MIE_TINT = np.array([0.826, 1.0, 1.225])
"""Extinction by haze relative to green: an Ångström exponent of 1."""
MIE_ALBEDO = 0.96
MIE_HEIGHT, HAZE_HEIGHT, RAYLEIGH_HEIGHT = 1.2, 0.6, 8.0
"""Scale heights, km: of haze, of the low haze of ``sky.haze``, of molecules."""
GROUND = 0.06
"""Albedo of the sea."""
SUN_RADIUS = 0.0047
"""Angular radius of the sun, rad."""
EYE = 0.02
"""Height of the eye, km."""
_HEIGHTS, _SLANTS = 40, 96
_HORIZON_MASS = math.sqrt(0.5 * math.pi * EARTH / HAZE_HEIGHT)
"""Air mass along the horizon of a layer of the low haze's scale height."""


def _densities(height: Floats) -> Floats:
    """Density relative to the greatest, of molecules, haze, low haze and ozone, at heights (...,) km; (..., 4)."""
    up = np.maximum(height, 0.0)
    falling = (np.exp(-up / scale) for scale in (RAYLEIGH_HEIGHT, MIE_HEIGHT, HAZE_HEIGHT))
    return np.stack((*falling, np.maximum(1.0 - np.abs(up - 25.0) / 15.0, 0.0)), -1)


def _to_top(radius: Floats, cosine: Floats) -> Floats:
    """Distance to the end of the atmosphere from a radius (km) along a zenith cosine, km."""
    return -radius * cosine + np.sqrt(np.maximum(TOP**2 - radius**2 * (1.0 - cosine**2), 0.0))


def _horizon(radius: Floats) -> Floats:
    """Zenith cosine of the ground's horizon seen from a radius (km)."""
    return -np.sqrt(np.maximum(1.0 - (EARTH / radius) ** 2, 0.0))


@lru_cache(maxsize=1)
def _columns() -> Floats:
    """Log of the columns of the four species, (heights, slants, 4), from roots of the height and of the slant."""
    height = (TOP - EARTH) * np.linspace(0.0, 1.0, _HEIGHTS)[:, None] ** 2
    radius = EARTH + height
    low = _horizon(radius)
    cosine = low + (1.0 - low) * np.linspace(0.0, 1.0, _SLANTS)[None, :] ** 2
    way = _to_top(radius, cosine)
    # Steps grow from the ends: dense air lies at the start, or for rays that first descend at the lowest point.
    lowest = np.clip(-radius * cosine, 0.0, way)
    total = np.zeros((_HEIGHTS, _SLANTS, 4))
    for start, end in ((lowest, np.zeros_like(way)), (lowest, way)):
        for node, weight in _gauss(24):
            s = start + (end - start) * node**2
            h = np.sqrt(radius**2 + s**2 + 2.0 * radius * cosine * s) - EARTH
            total += (weight * 2.0 * node * np.abs(end - start))[..., None] * _densities(h)
    return np.log(np.maximum(total, 1e-12))


def _read(logs: Floats, x: Floats, y: Floats) -> Floats:
    """Values whose logs (rows, columns, n) are read bilinearly at rows ``x`` and columns ``y`` (...,); (..., n)."""
    i, j = (np.minimum(at.astype(int), side - 2) for at, side in zip((x, y), logs.shape, strict=False))
    a, b = (x - i)[..., None], (y - j)[..., None]
    upper = logs[i, j] * (1.0 - b) + logs[i, j + 1] * b
    lower = logs[i + 1, j] * (1.0 - b) + logs[i + 1, j + 1] * b
    result: Floats = np.exp(upper * (1.0 - a) + lower * a)
    return result


def _gauss(count: int) -> list[tuple[float, float]]:
    """Nodes in [0, 1] and weights of Gauss and Legendre's quadrature."""
    nodes, weights = np.polynomial.legendre.leggauss(count)
    return list(zip(0.5 * (nodes + 1.0), 0.5 * weights, strict=True))


def _column(radius: Floats, cosine: Floats) -> Floats:
    """Columns of the four species to the end of the atmosphere, km; (..., 4). Rays below the horizon as along it."""
    low = _horizon(radius)
    x = np.sqrt(np.clip((radius - EARTH) / (TOP - EARTH), 0.0, 1.0)) * (_HEIGHTS - 1)
    y = np.sqrt(np.clip((cosine - low) / (1.0 - low), 0.0, 1.0)) * (_SLANTS - 1)
    return _read(_columns(), x, y)


def disc_shown(radius: Floats, cosine: Floats) -> Floats:
    """Share of the sun's disc above the horizon, from a radius (km) and the zenith cosine of its centre; (...,)."""
    return smoothstep(-1.0, 1.0, (cosine - _horizon(radius)) / SUN_RADIUS)


@dataclass(frozen=True)
class _Paths:
    """Rays along which light is scattered a second time, the same in every atmosphere."""

    shape: tuple[int, ...]
    """Heights, sun's cosines, rays' cosines, and azimuths from the sun."""
    weights: Floats
    """Of the rays' cosines, of sum 1."""
    steps: tuple[tuple[Floats, Floats, Floats, Floats], ...]
    """Length of each step, km; densities there; share of the sun's disc and the columns of air toward it."""
    hits: NDArray[np.bool_]
    """Whether a ray meets the ground."""
    ground: tuple[Floats, Floats]
    """Share of the sun's disc and the columns toward it from where rays meet the ground."""
    ground_up: Floats
    """Zenith cosine of the sun there."""


@lru_cache(maxsize=1)
def _paths() -> _Paths:
    height = (TOP - EARTH) * ((np.linspace(0.0, 13.0, 14) + 0.02) / 14.0) ** 2
    sun = np.sign(np.linspace(-1.0, 1.0, 33)) * np.linspace(-1.0, 1.0, 33) ** 2
    ups, up_weights = np.polynomial.legendre.leggauss(12)
    around = (np.arange(6) + 0.5) * (math.pi / 6)
    radius = (EARTH + height)[:, None, None, None]
    s_up, v_up, turn = sun[None, :, None, None], ups[None, None, :, None], around[None, None, None, :]
    between = v_up * s_up + np.sqrt(1.0 - v_up**2) * np.sqrt(1.0 - s_up**2) * np.cos(turn)
    beneath = radius**2 * (1.0 - v_up**2) - EARTH**2
    hits = (v_up < 0.0) & (beneath < 0.0)
    way = np.where(hits, -radius * v_up - np.sqrt(np.maximum(-beneath, 0.0)), _to_top(radius, v_up))
    shape = np.broadcast_shapes(way.shape, between.shape)
    steps = []
    for node, weight in _gauss(14):
        s = way * node**2
        there = np.sqrt(radius**2 + s**2 + 2.0 * radius * v_up * s)
        up = (radius * s_up + s * between) / there
        steps.append((way * 2.0 * node * weight, _densities(there - EARTH), disc_shown(there, up), _column(there, up)))
    ground_up = (radius * s_up + way * between) / EARTH
    ground = np.full(shape, EARTH + 1e-3)
    toward = (disc_shown(ground, ground_up), _column(ground, ground_up))
    return _Paths(shape, 0.5 * up_weights, tuple(steps), hits, toward, ground_up)


@dataclass(frozen=True)
class Atmosphere:
    """An atmosphere. ``mie``: optical depth of haze at the zenith; ``haze``: of the low haze along the horizon."""

    mie: float
    haze: float

    @cached_property
    def extinction(self) -> Floats:
        """Extinction of the four species per unit of density, 1/km; (4, 3)."""
        return np.stack(
            (RAYLEIGH, self.mie / MIE_HEIGHT * MIE_TINT, self.haze / (_HORIZON_MASS * HAZE_HEIGHT) * MIE_TINT, OZONE)
        )

    def depth(self, height: float) -> Floats:
        """(3,) optical depth between the eye and a lamp at this sine of elevation; below the horizon as along it."""
        return _column(np.array(EARTH + EYE), np.array(height)) @ self.extinction

    def _arriving(self, shown: Floats, column: Floats) -> Floats:
        """Share of a sun's light that arrives, by that of its disc (...,) and the columns of air (..., 4); (..., 3)."""
        return shown[..., None] * np.exp(-column @ self.extinction)

    def _scattering(self, dense: Floats) -> tuple[Floats, Floats, Floats]:
        """Scattering by molecules and by haze, and extinction, at these densities (..., 4), 1/km; (..., 3) each."""
        each = dense[..., None] * self.extinction
        mie: Floats = MIE_ALBEDO * (each[..., 1, :] + each[..., 2, :])
        return each[..., 0, :], mie, each.sum(axis=-2)

    @cached_property
    def _further(self) -> Floats:
        """Log of the radiance of light scattered twice or more, per unit of scattering; (heights, sun's cosines, 3)."""
        paths = _paths()
        once, share = np.zeros((*paths.shape, 3)), np.zeros((*paths.hits.shape, 3))
        clear = np.ones_like(share)
        for step, dense, shown, column in paths.steps:
            rayleigh, mie, lost = self._scattering(dense)
            half = np.exp(-0.5 * lost * step[..., None])
            clear = clear * half
            sent = clear * (rayleigh + mie) * step[..., None]
            once += sent * self._arriving(shown, column) / (4.0 * math.pi)
            share += sent
            clear = clear * half
        bounced = self._arriving(*paths.ground) * np.maximum(paths.ground_up, 0.0)[..., None]
        hits = paths.hits[..., None]
        once += np.where(hits, clear * GROUND / math.pi * bounced, 0.0)
        share += np.where(hits, clear * GROUND, 0.0)
        weight_of = paths.weights[:, None, None] / paths.shape[-1]
        second = (once * weight_of).sum(axis=(2, 3))
        ratio = (share * weight_of * paths.shape[-1]).sum(axis=(2, 3))
        result: Floats = np.log(np.maximum(second / (1.0 - ratio), 1e-12))
        return result

    def sky(self, up: Floats, gamma: Floats, sun: float, steps: int = 40) -> tuple[Floats, Floats]:
        """Radiance toward heights ``up`` (...,) of unit directions in [0, 1] at cosines ``gamma`` (...,) from the sun.

        ``sun``: sine of the sun's elevation. The light of molecules and of further orders, and that of haze over its
        phase function; (..., 3) each.
        """
        radius = EARTH + EYE
        way = _to_top(np.full(up.shape, radius), up)
        smooth, hazy = np.zeros((*up.shape, 3)), np.zeros((*up.shape, 3))
        clear = np.ones_like(smooth)
        phase = (3.0 / (16.0 * math.pi) * (1.0 + gamma**2))[..., None]
        for node, weight in _gauss(steps):
            s, step = way * node**3, way * 3.0 * node**2 * weight
            there = np.sqrt(radius**2 + s**2 + 2.0 * radius * up * s)
            local = (radius * sun + s * gamma) / there
            rayleigh, mie, lost = self._scattering(_densities(there - EARTH))
            half = np.exp(-0.5 * lost * step[..., None])
            clear = clear * half
            arrives = self._arriving(disc_shown(there, local), _column(there, local))
            x = np.clip(np.sqrt(np.maximum(there - EARTH, 0.0) / (TOP - EARTH)) * 14.0, 0.0, 13.0)
            more = _read(self._further, x, (np.sign(local) * np.sqrt(np.abs(local)) + 1.0) * 16.0)
            smooth += clear * step[..., None] * (rayleigh * phase * arrives + (rayleigh + mie) * more)
            hazy += clear * step[..., None] * mie * arrives
            clear = clear * half
        return smooth, hazy
