"""No preset's camera is under water by accident: at most 0.02 % of its time, by how high its waves are how often."""

import math

import numpy as np

from seafoam.effects.bounds import max_surface_height
from seafoam.ocean.basics.dispersion import wave_level
from seafoam.ocean.waves.cascades import RAISED, cascades
from seafoam.ocean.waves.rings import ring_height
from seafoam.ocean.waves.wakes import joint_height, wakes
from seafoam.reference.types import Floats
from seafoam.scene.models import Scene
from seafoam.scene.presets import load_preset, preset_names

MOST = 2e-4
"""Greatest share of the time under water."""
MOMENTS = 400_000


def heights(scene: Scene) -> Floats:
    """Height of the water over a place at moments far apart, m.

    Waves at any phase, as high as in their groups at most; a normal sea; rings, wakes and surf by the most they add.
    """
    random = np.random.default_rng(1)
    total = np.full(MOMENTS, ring_height(scene) + joint_height(wakes(scene.boats)))
    if scene.shore is not None:
        total += scene.shore.surf.height
    for wave in scene.waves:
        turn = random.uniform(0.0, 2.0 * math.pi, MOMENTS)
        total += wave.amplitude * (0.5 + 0.5 * np.sin(turn)) ** wave.exponent - wave_level(wave)
    if scene.sea is not None and scene.sea.wind_speed > 0.0:
        variance = sum(tile.variance for tile in cascades(scene.sea, scene.water.depth)[:RAISED])
        total += random.normal(0.0, math.sqrt(variance), MOMENTS)
    return total


def test_the_cameras_stay_above_water() -> None:
    judged = 0
    for name in preset_names():
        scene = load_preset(name).scene.settled
        height = scene.camera.position[1]
        if height <= max_surface_height(scene):
            judged += 1
            under = float((heights(scene) >= height).mean())
            assert under <= MOST, f"{name}: {100.0 * under:.2f} % of the time under water"
    assert judged > 0
