"""A frame of a scene: rays through pixels, the surface under them, foam, light, and the average."""

import hashlib
import json
from dataclasses import dataclass

import numpy as np

from seafoam.reference.foam.coverage import Assets
from seafoam.reference.renderer.camera import SampleGrid
from seafoam.reference.renderer.shade import SampleShader
from seafoam.reference.renderer.state import Mode
from seafoam.reference.spray import Drops, Splats, Sprayed
from seafoam.reference.types import Floats, Pair
from seafoam.scene import Camera, Scene, non_defaults

CHUNK = 32768  # rays shaded at a time, so that their arrays fit in the processor's cache
JITTER_SEED = 20110


@dataclass(frozen=True, eq=False)
class ReferenceFrame:
    """A picture in linear light, rows from the top."""

    rgb: Floats
    """(H, W, 3), averaged over the samples, exposed, not tone mapped."""
    alpha: Floats
    """(H, W), mean foam amount in [0, 1]; 0 in the sky."""
    amount: Floats
    """(H·n, W·n), foam amount of each sample, at most 1."""
    depression: Floats
    """(H, W), angle of each pixel's middle ray below the horizon, rad."""


def scene_sha256(scene: Scene) -> str:
    """SHA-256, in hexadecimal, of the settled scene's :func:`~seafoam.scene.non_defaults`, as canonical JSON.

    A new field of the schema changes none, a changed default does.
    """
    text = json.dumps(non_defaults(scene.settled), sort_keys=True, separators=(",", ":"), allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()


def render(
    scene: Scene | Sprayed,
    *,
    time: float,
    width: int,
    height: int,
    samples: int = 1,
    camera: Camera | None = None,
    mode: Mode = "same-samples",
) -> ReferenceFrame:
    """Render a scene at a time (s) with ``samples``² samples per pixel.

    ``same-samples`` places them on the grid of section 1 and filters as the shaders do; ``converged`` places one at
    random in each cell of the grid, always the same, and replaces the filtered look by its limit and every texture
    level by level 0. ``camera`` replaces the scene's. Waves and ripples are never slope-filtered. Raises ``ValueError``
    for spray without its drops at this time from this camera (:func:`seafoam.accuracy.truth.sprayed`).
    """
    scene, drops = (scene.scene, scene.drops) if isinstance(scene, Sprayed) else (scene, None)
    scene = scene.settled
    if scene.spray is not None and drops is None:
        raise ValueError("spray needs its drops as a renderer throws them (seafoam.accuracy.truth.sprayed)")
    grid = SampleGrid(scene.camera if camera is None else camera, width, height, samples)
    shader = SampleShader(scene, time, grid, mode, Assets.for_scene(scene))
    flying = None
    if drops is not None and scene.spray is not None and not shader.covered:
        flying = Splats(shader, Drops.of(drops))
    X, Y = _clip_positions(grid, mode)
    count = max(1, CHUNK // samples**2) * samples**2
    parts = [shader.shade(X[i : i + count], Y[i : i + count]) for i in range(0, X.size, count)]

    def placed(values: Floats) -> Floats:
        """Samples (r, ...), pixel by pixel, as (height, samples, width, samples, ...)."""
        by_pixel = values.reshape(height, width, samples, samples, *values.shape[1:])
        return np.ascontiguousarray(by_pixel.swapaxes(1, 2))

    picture, amount = (placed(np.concatenate(part)) for part in zip(*parts, strict=True))
    shape = grid.rows, grid.columns
    if flying is not None:
        flying.draw_over(picture.reshape(*shape, 3), placed(X).reshape(shape), placed(Y).reshape(shape))
    return ReferenceFrame(picture.mean(axis=(1, 3)), amount.mean(axis=(1, 3)), amount.reshape(shape), grid.depression)


def _clip_positions(grid: SampleGrid, mode: Mode) -> Pair:
    """Clip positions X and Y of all samples, pixel by pixel from the upper left one; (r,) each."""
    samples, cell, pixel = grid.samples, np.arange(grid.samples), np.arange(grid.width * grid.height)[:, None, None]
    offset = np.full((pixel.size, samples, samples, 2), 0.5)
    if mode == "converged":
        offset = np.random.default_rng(JITTER_SEED).random(offset.shape)
    down = pixel // grid.width * samples + cell[:, None] + offset[..., 0]
    along = pixel % grid.width * samples + cell + offset[..., 1]
    return (2.0 * along / grid.columns - 1.0).ravel(), (1.0 - 2.0 * down / grid.rows).ravel()
