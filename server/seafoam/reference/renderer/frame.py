"""A frame of a scene: rays through pixels, the surface under them, foam, light, and the average."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from seafoam.reference.renderer import camera as cameras
from seafoam.reference.renderer.assets import Assets
from seafoam.reference.renderer.shade import Shader
from seafoam.reference.renderer.state import Mode
from seafoam.reference.spray import spray
from seafoam.reference.types import Bools, Floats
from seafoam.scene.camera import Camera
from seafoam.scene.models import Scene

CHUNK = 32768
"""Rays at a time: their arrays stay in the processor's cache."""
JITTER_SEED = 20110


@dataclass(frozen=True, eq=False)
class Frame:
    """A picture in linear light, rows from the top."""

    rgb: Floats
    """(H, W, 3), averaged over the samples, exposed, not tone mapped."""
    alpha: Floats
    """(H, W), mean foam amount in [0, 1]; 0 in the sky."""
    amount: Floats
    """(H·n, W·n), foam amount of each sample, at most 1; in converged mode of each cell's one jittered sample."""
    hit: Bools
    """(H·n, W·n), whether a sample met the surface."""
    depression: Floats
    """(H, W), angle of each pixel's middle ray below the horizon, rad."""
    samples: int
    """n, samples along each side of a pixel."""


def render(
    scene: Scene,
    *,
    time: float,
    width: int,
    height: int,
    samples: int = 1,
    camera: Camera | None = None,
    mode: Mode = "same-samples",
    assets: Assets | None = None,
) -> Frame:
    """Render a scene at a time (s) with ``samples``² samples a pixel.

    ``same-samples`` sets them on the grid of section 1 and filters as the page says; ``converged`` jitters one in each
    cell of the grid, always in the same places, and puts the limit in place of the filtered look and level 0 in place
    of every texture level. ``camera`` stands in for the scene's. Waves and ripples are never slope-filtered.
    """
    if assets is None:
        assets = Assets.for_scene(scene)
    chosen = scene.camera if camera is None else camera
    view = cameras.view(chosen, width, height)
    shader = Shader(scene, time, view, width, height, samples, mode, assets)
    discs = _discs(shader, time, height * samples)
    pixels = width * height
    rgb = np.empty((pixels, 3))
    alpha = np.empty(pixels)
    amount = np.empty((height, samples, width, samples))
    hit = np.empty((height, samples, width, samples), np.bool_)
    kept = (height, samples, width, samples) if discs is not None else (0, 0, 0, 0)
    picture, clip_x, clip_y = np.empty((*kept, 3)), np.empty(kept), np.empty(kept)
    cell = np.arange(samples)
    jitter = np.random.default_rng(JITTER_SEED)
    step = max(1, CHUNK // samples**2)
    for start in range(0, pixels, step):
        index = np.arange(start, min(start + step, pixels))
        row, column = index[:, None, None] // width, index[:, None, None] % width
        places = (index.size, samples, samples)
        offset = jitter.random((*places, 2)) if mode == "converged" else np.full((*places, 2), 0.5)
        down = row * samples + cell[:, None] + offset[..., 0]
        along = column * samples + cell + offset[..., 1]
        X = 2.0 * along / (samples * width) - 1.0
        Y = 1.0 - 2.0 * down / (samples * height)
        colour, a, met = shader.shade(X.ravel(), Y.ravel())
        where = (row, cell[:, None], column, cell)
        if discs is not None:
            picture[where], clip_x[where], clip_y[where] = colour.reshape(*places, 3), X, Y
        rgb[index] = colour.reshape(index.size, samples**2, 3).mean(axis=1)
        alpha[index] = a.reshape(index.size, samples**2).mean(axis=1)
        amount[where] = a.reshape(places)
        hit[where] = met.reshape(places)
    grid = (height * samples, width * samples)
    if discs is not None:
        laid = picture.reshape(*grid, 3)
        spray.lay_over(laid, clip_x.reshape(grid), clip_y.reshape(grid), discs)
        rgb[:] = laid.reshape(height, samples, width, samples, 3).mean(axis=(1, 3)).reshape(pixels, 3)
    return Frame(
        rgb=rgb.reshape(height, width, 3),
        alpha=alpha.reshape(height, width),
        amount=amount.reshape(grid),
        hit=hit.reshape(grid),
        depression=cameras.depression(view, width, height),
        samples=samples,
    )


def _discs(state: Shader, time: float, rows: int) -> spray.Discs | None:
    of, coast = state.scene.spray, state.coast
    if of is None or state.covered:
        return None
    if coast is None:
        drops, life = spray.from_waves(of, state.scene, state.waves, time, state.origin), of.life
    else:
        drops, life = spray.from_rocks(of, coast, time), spray.life_on_rocks(of, coast)
    lit = state.scene.light
    shown = spray.Shown(state.air, 1.0 if lit is None else lit.visibility, state.exposure)
    return spray.discs(of, drops, life, state.view, rows, state.relief, coast, shown)
