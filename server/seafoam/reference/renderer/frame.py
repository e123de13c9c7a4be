"""A frame of a scene: rays through pixels, the surface under them, foam, light, and the average."""

import hashlib
import json
from dataclasses import dataclass

import numpy as np

from seafoam.reference.foam.coverage import Assets
from seafoam.reference.renderer import camera as cameras
from seafoam.reference.renderer.shade import SampleShader
from seafoam.reference.renderer.state import Mode
from seafoam.reference.spray.births import drops
from seafoam.reference.spray.splats import splats
from seafoam.reference.types import Bools, Floats, Indices
from seafoam.scene.base import non_defaults
from seafoam.scene.camera import Camera
from seafoam.scene.models import Scene

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
    hit: Bools
    """(H·n, W·n), whether a sample met the surface."""


def scene_sha256(scene: Scene) -> str:
    """SHA-256, in hexadecimal, of the settled scene's :func:`~seafoam.scene.base.non_defaults`, as canonical JSON.

    A new field of the schema changes none, a changed default does.
    """
    text = json.dumps(non_defaults(scene.settled), sort_keys=True, separators=(",", ":"), allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()


def render(
    scene: Scene,
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
    level by level 0. ``camera`` replaces the scene's. Waves and ripples are never slope-filtered.
    """
    scene = scene.settled
    view = cameras.view(scene.camera if camera is None else camera, width, height)
    grid = cameras.SampleGrid(view, width, height, samples)
    shader = SampleShader(scene, time, grid, mode, Assets.for_scene(scene))
    flying = None
    if scene.spray is not None and not shader.covered:
        thrown = drops(scene, time, shader.origin, view.ray_z[::2], shader.surface.coast)
        if thrown is not None:
            flying = splats(scene, thrown, grid, shader.surface, shader.fleet, shader.lighting)
    pixels, shape = width * height, (height, samples, width, samples)
    picture, clip_x, clip_y = np.empty((*shape, 3)), np.empty(shape), np.empty(shape)
    amount, hit = np.empty(shape), np.empty(shape, np.bool_)
    jitter = np.random.default_rng(JITTER_SEED)
    step = max(1, CHUNK // samples**2)
    for start in range(0, pixels, step):
        index = np.arange(start, min(start + step, pixels))
        cells = (index.size, samples, samples)
        offset = jitter.random((*cells, 2)) if mode == "converged" else np.full((*cells, 2), 0.5)
        where, X, Y = _samples(index, width, height, samples, offset)
        colour, a, met = shader.shade(X.ravel(), Y.ravel())
        picture[where], clip_x[where], clip_y[where] = colour.reshape(*cells, 3), X, Y
        amount[where], hit[where] = a.reshape(cells), met.reshape(cells)
    grid_shape = grid.rows, grid.columns
    if flying is not None:
        flying.draw_over(picture.reshape(*grid_shape, 3), clip_x.reshape(grid_shape), clip_y.reshape(grid_shape))
    return ReferenceFrame(
        rgb=picture.mean(axis=(1, 3)),
        alpha=amount.mean(axis=(1, 3)),
        amount=amount.reshape(grid_shape),
        hit=hit.reshape(grid_shape),
    )


def _samples(
    index: Indices, width: int, height: int, samples: int, offset: Floats
) -> tuple[tuple[Indices, Indices, Indices, Indices], Floats, Floats]:
    """Places of pixels' samples in arrays (height, samples, width, samples), and their X, Y in clip space.

    ``offset``: (pixels, samples, samples, 2), position in each cell of the grid, [0, 1).
    """
    cell = np.arange(samples)
    row, column = index[:, None, None] // width, index[:, None, None] % width
    down = row * samples + cell[:, None] + offset[..., 0]
    along = column * samples + cell + offset[..., 1]
    X = 2.0 * along / (samples * width) - 1.0
    Y = 1.0 - 2.0 * down / (samples * height)
    return (row, cell[:, None], column, cell), X, Y
