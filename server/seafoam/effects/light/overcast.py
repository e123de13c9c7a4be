"""The clouds' part of the light: what they take, and what they give. docs/formulae.md, section 9."""

import math
from functools import lru_cache
from statistics import NormalDist

import numpy as np

from seafoam.effects.light import atmosphere
from seafoam.ocean.arrays import Floats, read_only, smooth, smoothstep
from seafoam.scene import Cirrus, Clouds, Light

_SLICES = np.array([[0.0], [0.4], [0.8]])
"""Heights of the slices of clouds, of their depth."""
_LATTICE = 8192
"""Points of the means over noise."""
TAPER, CORE, DARK, RELIEF = 0.9, -1.2, 0.3, 0.3
"""Rise of the edge's noise from the foot of a cloud to its top; noise over which a cloud's core deepens; darkness of
what diffuse light passes, per optical depth; shading by the rise toward the lamp. As in ``light/clouds.glsl@layer``."""
RAYLEIGH_HEIGHT, MIE_HEIGHT = 8000.0, 1200.0
"""Scale heights of molecules and of haze, m."""
SHADED = 0.85
"""Share of the air under an overcast sky that no lamp lights."""
_EDGE_NODES = 1024
"""Steps of the means over the edge of clouds."""
_NORMAL_NODES = 65536
"""Steps of the means over the normal law, from -8 to 8 standard deviations."""
NO_NOISE = 20.0
"""Noise value that is never reached."""
LEAST_PASSED = 1e-4
"""Least mean transmittance by which that of a column is divided."""


def cloud_start(clouds: Clouds) -> float:
    """Noise value above which there is cloud: the normal quantile of the cover, at mid-edge."""
    if clouds.cover == 0.0:
        return NO_NOISE
    cover = min(max(clouds.cover, 1e-4), 1.0 - 1e-4)
    return -NormalDist().inv_cdf(cover) - 0.25 * clouds.softness


def cirrus_start(cirrus: Cirrus) -> float:
    """Noise value above which there are streaks: the normal quantile of their cover, at mid-edge."""
    if cirrus.cover == 0.0:
        return NO_NOISE
    return -NormalDist().inv_cdf(min(max(cirrus.cover, 1e-3), 1.0 - 1e-3)) - 1.2


def cloud_light(light: Light, altitude: float) -> Floats:
    """(3,) irradiance of the lamp at an altitude (m): through the air above, and until later after sunset."""
    height = atmosphere.lamp(light)[1]
    above = np.array(atmosphere.SUN_POWER * smooth(-0.06, 0.02, height))
    if atmosphere.moon_is_lamp(light):
        above = atmosphere.moon_power(light)
    haze = atmosphere.mie_depth(light) * math.exp(-altitude / MIE_HEIGHT)
    depth = atmosphere.RAYLEIGH * math.exp(-altitude / RAYLEIGH_HEIGHT) + haze
    return above * np.exp(-depth * atmosphere.air_mass(height))


def cloud_sky(light: Light) -> Floats:
    """(3,) radiance of the skylight on clouds, mean over all directions."""
    return 0.6 / math.pi * atmosphere.clear_irradiance(light)


def irradiance(light: Light) -> Floats:
    """(3,) irradiance of sky and clouds on level water."""
    clear = atmosphere.clear_irradiance(light)
    clouds = light.sky.clouds if light.sky is not None else None
    if clouds is None:
        return clear
    cover = cloud_mean(clouds)
    return (1.0 - cover) * clear + cover * math.pi * _overcast(light, clouds)


def cloud_far(light: Light, clouds: Clouds) -> tuple[float, ...]:
    """Light of the air along the horizon that clouds keep the lamp from: its radiance, premultiplied, and its share."""
    share = SHADED * cloud_mean(clouds)
    return *(share * _overcast(light, clouds)), share


def gap_light(clouds: Clouds | None) -> float:
    """Greatest factor of the clouds' shadows on the lamp's mean light: where no cloud stands."""
    if clouds is None:
        return 1.0
    return 1.0 + clouds.shadows * (1.0 / max(1.0 - cloud_mean(clouds), LEAST_PASSED) - 1.0)


@lru_cache(maxsize=64)
def cloud_gap(clouds: Clouds) -> tuple[float, float, float]:
    """The normal law that stands for a column's transmittance by its noise: middle and variance of its edge, and the
    transmittance of the thickest clouds. Its mean over the noise is one less :func:`cloud_mean`."""
    noise = (np.arange(_NORMAL_NODES) + 0.5) / _NORMAL_NODES * 16.0 - 8.0
    rise = np.diff(_column(clouds, noise, noise, 0.0)[0])
    middle = 0.5 * (noise[1:] + noise[:-1])
    mean = float(rise @ middle / rise.sum())
    variance = float(rise @ (middle - mean) ** 2 / rise.sum())
    thickest = math.exp(-clouds.thickness)
    share = (1.0 - cloud_mean(clouds) - thickest) / (1.0 - thickest)
    open_sky = NormalDist().inv_cdf(min(max(share, 1e-6), 1.0 - 1e-6))
    return open_sky * math.sqrt(1.0 + variance), variance, thickest


@lru_cache(maxsize=64)
def cloud_mean(clouds: Clouds | None) -> float:
    """Mean fraction of the light from above that clouds take: a column's opacity over the normal law of the noise."""
    if clouds is None or clouds.cover == 0.0:
        return 0.0
    noise = (np.arange(_NORMAL_NODES) + 0.5) / _NORMAL_NODES * 16.0 - 8.0
    weight = np.exp(-0.5 * noise * noise)
    return float(weight @ _column(clouds, noise, noise, 0.0)[0] / weight.sum())


def cloud_edge(clouds: Clouds) -> tuple[float, float, float, float]:
    """Mean and standard deviation of the noise over a slice's start, where its opacity rises; the mean opacity less
    that of edges there, widened by the whole variance; and what parted slices are more opaque."""
    t = (np.arange(_EDGE_NODES) + 0.5) / _EDGE_NODES
    rise = t * (1.0 - t) * np.exp(-clouds.thickness / 3.0 * smoothstep(0.0, 1.0, t))
    rise /= rise.sum()
    middle = float(rise @ t)
    width = float(np.sqrt(rise @ (t - middle) ** 2)) * clouds.softness
    middle *= clouds.softness
    wide = cloud_start(clouds) + TAPER * _SLICES + middle
    wide -= wide * width / math.hypot(width, 1.0)
    missed = cloud_mean(clouds) - float(_column(clouds, wide, wide[1], 0.0)[0][0])
    return middle, width, missed, _means(clouds, 0.0)[1]


def cloud_means(light: Light, clouds: Clouds) -> Floats:
    """(2, 3) means of lamp, haze's scattering and sky in the light of clouds, and of those whose slices are parted."""
    return _means(clouds, atmosphere.lamp(light)[1])[0]


def _overcast(light: Light, clouds: Clouds) -> Floats:
    sunny, forward, grey = cloud_means(light, clouds).mean(axis=0)
    lamp, sky = cloud_light(light, clouds.height), cloud_sky(light)
    result: Floats = (sunny + forward / (4.0 * math.pi)) * lamp + grey * sky
    return result


@lru_cache(maxsize=1)
def _lattice() -> Floats:
    """Normal numbers (5, n): an additive recurrence by powers of the root of x^6 = x + 1 (Roberts 2018)."""
    steps = 1.1347241384015194 ** -np.arange(1.0, 6.0)
    shares = np.clip(np.mod(0.5 + np.outer(steps, np.arange(1.0, _LATTICE + 1.0)), 1.0), 1e-9, 1.0 - 1e-9)
    quantile = NormalDist().inv_cdf
    return np.array([[quantile(value) for value in row] for row in shares.tolist()])


@lru_cache(maxsize=64)
def _means(clouds: Clouds, height: float) -> tuple[Floats, float]:
    """Means of :func:`_column` over the noise, those of radiance weighted by the opacity: of slices above each other,
    of slices that have only the finer octaves in common, (2, 3), and what these are more opaque."""
    if clouds.cover * clouds.thickness == 0.0:
        return np.zeros((2, 3)), 0.0
    fine, lower, here, upper, other = _lattice()
    ahead = 0.712 * here + 0.382 * fine + 0.589 * other
    means, covers = [], []
    for slices in ((here, here, here), (lower, here, upper)):
        noise = 0.58 * fine + math.sqrt(1.0 - 0.58 * 0.58) * np.stack(slices)
        opaque, *shines = _column(clouds, noise, ahead, height)
        covers.append(float(opaque.mean()))
        means.append([opaque @ one / opaque.sum() for one in shines])
    return read_only(np.array(means)), covers[1] - covers[0]


def _column(clouds: Clouds, noise: Floats, ahead: Floats, height: float) -> tuple[Floats, Floats, Floats, Floats]:
    """Opacity of a column of cloud, and its radiance per lamp, haze's scattering and sky; (n,) each.

    ``noise``: of the slices, (3, n), or of all (n,); ``ahead`` (n,): toward the lamp, at this sine of elevation.
    """
    start = cloud_start(clouds) + TAPER * _SLICES
    density = smoothstep(0.0, 1.0, (noise - start) / clouds.softness)
    shade = smoothstep(0.0, 1.0, (ahead - start - 0.2 * TAPER) / clouds.softness)
    core = np.maximum(noise - np.maximum(start + 0.5 * clouds.softness, CORE), 0.0)
    deep = clouds.thickness / 3.0 * density
    above = clouds.thickness * (np.array([[0.5], [0.33], [0.17]]) * density + 0.15 * core * core)
    above[:2] += np.stack((deep[1] + deep[2], deep[2]))
    middle = noise[1] if noise.ndim > 1 else noise
    relief = np.clip(1.0 + RELIEF * (middle - ahead), 0.35, 1.25)
    direct, diffuse = relief * np.exp(-0.5 * clouds.thickness * shade), relief / (1.0 + DARK * above)
    lit = 0.3 * (0.55 * direct + 0.45 * math.sqrt(max(height, 0.0) + 0.03) * diffuse)
    least = np.array([[0.6], [0.8], [1.0]])
    sky = (least + (1.0 - least) * direct) * (0.35 + 0.65 * diffuse)
    stays = np.exp(-deep)
    seen = np.stack((np.ones_like(stays[0]), stays[0], stays[0] * stays[1])) * (1.0 - stays)
    left = np.exp(-deep.sum(axis=0))
    whole = np.maximum(1.0 - left, 1e-6)
    return 1.0 - left, (seen * lit).sum(axis=0) / whole, 0.3 * left, (seen * sky).sum(axis=0) / whole
