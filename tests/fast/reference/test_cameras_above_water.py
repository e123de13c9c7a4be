"""No preset's camera is under water by accident: at most 0.02 % of an hour, by the waves' float64 sums."""

import math

import numpy as np
import pytest

from seafoam.effects.bounds import max_surface_height
from seafoam.ocean.basics.dispersion import angular_frequency, wavevector
from seafoam.ocean.basics.levels import wave_level
from seafoam.ocean.waves.cascades import BAND, RAISED, Cascade, cascades
from seafoam.ocean.waves.rings import ring_height
from seafoam.ocean.waves.wakes import joint_height, wakes
from seafoam.reference.types import Floats
from seafoam.reference.waves.groups import group_factor
from seafoam.reference.waves.sea import sea_surface
from seafoam.scene.models import Scene
from seafoam.scene.presets import load_preset, preset_names
from support.sweep import spread

MOST = 2e-4
"""Greatest share of an hour under water."""
TIMES = np.arange(0.0, 3600.0, 0.5)
KEPT = 0.9995
"""Share of a tile's variance in the waves that are summed."""


def tile_heights(of: Cascade, wanted: float, x: float, z: float, times: Floats) -> Floats:
    """Height of a displaced tile over (x, z) at each time, m; six steps find the water displaced there.

    Phases are reduced in float64; their sines and cosines are float32, which is exact to a millimetre here.
    """
    power = np.abs(of.h0).ravel() ** 2
    order = np.argsort(power)[::-1]
    kept = order[: int(np.searchsorted(np.cumsum(power[order]), KEPT * power.sum())) + 1]
    rows, columns = np.unravel_index(kept, of.h0.shape)
    step = 2.0 * math.pi / of.size
    kx, kz = step * (columns - BAND), step * (rows - BAND)
    k = np.maximum(np.hypot(kx, kz), 1e-300)
    turns = of.turns.ravel()[kept] / 2048.0
    start_turns = np.angle(of.h0.ravel()[kept]) / (2.0 * math.pi)
    amplitude = 2.0 * np.abs(of.h0.ravel()[kept])
    sums = np.stack([amplitude * kx / k, amplitude * kz / k]).astype(np.float32)
    by_x, by_z = (side[:, None].astype(np.float32) for side in (kx, kz))
    choppiness = of.choppiness(wanted)
    result = np.empty_like(times)
    for start in range(0, times.size, 400):
        t = times[start : start + 400]
        way = np.zeros((2, t.size), np.float32)
        whole = start_turns[:, None] - turns[:, None] * t + ((kx * x + kz * z) / (2.0 * math.pi))[:, None]
        phase = (2.0 * math.pi * (whole - np.rint(whole))).astype(np.float32)
        for _ in range(6):
            seen = phase + by_x * way[0] + by_z * way[1]
            result[start : start + 400] = amplitude.astype(np.float32) @ np.cos(seen)
            way = np.float32(choppiness) * (sums @ np.sin(seen))
    return np.clip(result, -of.limit, of.limit)


def heights(scene: Scene, x: float, z: float, times: Floats) -> Floats:
    """Height of the water over (x, z) at each time, m; rings, wakes and surf by the most that they add."""
    total = np.full(times.size, ring_height(scene) + joint_height(wakes(scene.boats)))
    if scene.shore is not None:
        total += scene.shore.surf.height
    single = np.zeros(times.size)
    for wave in scene.waves:
        kx, kz = wavevector(wave, scene.water.depth)
        theta = wave.phase + angular_frequency(wave) * times - kx * x - kz * z
        single += wave.amplitude * (0.5 + 0.5 * np.sin(theta)) ** wave.exponent - wave_level(wave)
    groups = group_factor(scene, 0.0, (x, z))
    total += single if groups is None else single * groups(np.zeros_like(times), np.zeros_like(times), -times)
    if scene.sea is not None and scene.sea.wind_speed > 0.0:
        for tile in cascades(scene.sea, scene.water.depth)[:RAISED]:
            total += tile_heights(tile, scene.sea.choppiness, x, z, times)
    return total


def test_the_sums_are_the_reference_surface() -> None:
    """At single times, to a tenth of the height's deviation: the largest waves alone are summed."""
    scene = load_preset("storm").scene.settled.model_copy(update={"waves": ()})
    assert scene.sea is not None
    tiles = cascades(scene.sea, scene.water.depth)[:RAISED]
    deviation = math.sqrt(sum(tile.variance for tile in tiles))
    for time in (0.0, 1733.5):
        surface = sea_surface(scene, time, (0.0, 0.0), texels=256)
        assert surface is not None
        want = surface.height(np.array([3.0]), np.array([-7.0]))[0]
        assert abs(heights(scene, 3.0, -7.0, np.array([time]))[0] - want) <= 0.1 * deviation


@pytest.mark.parametrize("name", spread(preset_names(), 3))
def test_the_camera_stays_above_water(name: str) -> None:
    scene = load_preset(name).scene.settled
    x, y, z = scene.camera.position
    if y > max_surface_height(scene):
        return
    under = float((heights(scene, x, z, TIMES) >= y).mean())
    assert under <= MOST, f"{name}: {100.0 * under:.2f} % of an hour under water"
