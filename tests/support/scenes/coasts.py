"""Shores that tests draw and compute."""

import base64
import io

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from seafoam.reference.renderer.relief import Relief
from seafoam.reference.shore import shore as truth
from seafoam.reference.waves.parametric import wave_set
from support.scenes import Foam, ParametricWave, Scene, Shore, Surf, SurfSaturation

SHORE = Shore(
    kind="islands",
    size=400.0,
    radius=60.0,
    depth=10.0,
    roughness=0.8,
    seed=3,
    surf=Surf(height=1.4, variation=0.6, heading=0.5, exposure=0.4),
)
SEA = Scene(
    waves=(ParametricWave(amplitude=0.4, wavelength=23.0, direction=0.4),),
    shore=SHORE,
    foam=Foam(saturation=(SurfSaturation(),)),
)
KINDS = ("beach", "island", "islands", "lagoon")


def coast(scene: Scene, time: float) -> truth.Coast:
    assert scene.shore is not None
    x, _, z = scene.camera.position
    return truth.Coast(scene.shore, time, (x, z), Relief((wave_set(scene, time, (x, z)),)))


def png(grey: NDArray[np.uint8]) -> str:
    held = io.BytesIO()
    Image.fromarray(grey).save(held, "PNG")
    return base64.b64encode(held.getvalue()).decode()
