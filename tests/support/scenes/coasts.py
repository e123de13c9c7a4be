"""Shores that tests draw and compute."""

import base64
import io
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from seafoam.planner import FramePlan
from seafoam.reference.light.light import Floor
from seafoam.reference.shore import shore as truth
from seafoam.reference.types import Relief
from seafoam.reference.waves.parametric import wave_set
from seafoam.render.gl.executor import Executor
from support.pictures import draw_target
from support.probe import shown
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
    x, _, z = scene.camera.position
    return truth.Coast(scene.shore, time, (x, z), Relief((wave_set(scene, time, (x, z)),)))


def places(executor: Executor, scene: Scene) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Where :func:`on_shore` evaluates: x and z, m from the eye, a little beyond the square too; (10,000,) each."""
    found = on_shore(executor, scene, "o_color = vec4(p, 0.0, 0.0);")
    return found[:, 0], found[:, 1]


def on_shore(executor: Executor, scene: Scene, body: str, **how: Any) -> NDArray[np.float64]:
    """:func:`shown` over the square of a scene's shore."""
    return shown(executor, scene, body, 1.04 * scene.shore.size, **how)


def map_of(executor: Executor, plan: FramePlan, target: str, time: float = 0.0) -> NDArray[np.float32]:
    """What the passes leave in a target; rows from z = 0."""
    # In every frame, so that nothing is kept and each target can be read.
    passes = tuple(one.model_copy(update={"when": "frame"}) for one in plan.passes)
    return draw_target(executor, plan.model_copy(update={"passes": passes, "kept": {}}), target, time)


def floor_of(floor: Floor) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Albedo (r, 3) and way of the light (r,), m: by what clear water leaves of light, and water of 1 km."""
    none, light = np.zeros(3), np.full(3, math.pi)
    albedo = floor(none, none, light)
    return albedo, -1e3 * np.log(floor(none + 1e-3, none, light)[:, 0] / albedo[:, 0])


def png(grey: NDArray[np.uint8]) -> str:
    held = io.BytesIO()
    Image.fromarray(grey).save(held, "PNG")
    return base64.b64encode(held.getvalue()).decode()
