"""Section 9: the share of the lamp's mean light that clouds leave to places."""

from __future__ import annotations

import math

import numpy as np

from seafoam.reference.foam.torn import Feet
from seafoam.reference.light.clouds import SLICES, WIDTH, CloudLayer, octaves, way_to
from seafoam.reference.types import Floats, dot, smoothstep

SHADOW_OCTAVES = 4
PENUMBRA = 0.00233
"""Standard deviation of directions over the sun's disc, rad."""
LEAST_PASSED = 1e-4
"""Least mean transmittance by which that of a column is divided."""
SPAN = 0.9
"""The farthest that slices are parted, cells."""


def sunlight(layer: CloudLayer, place: Floats, feet: Feet) -> Floats:
    """Factor (r,) of the lamp's mean light at places (r, 3), m from under the camera, with footprints; at least 0."""
    clouds = layer.clouds
    toward = layer.lit_by[None, :]
    way, slant = (float(part[0]) for part in way_to(toward, clouds.height))
    tall = clouds.depth / clouds.size
    level = way / clouds.size + SLICES[1] * min(tall / slant, SPAN)
    left = np.maximum(1.0 - place[:, 1] / clouds.height, 0.0)
    at = np.column_stack(
        (
            layer.place[0] + place[:, 0] / clouds.size + left * level * layer.lit_by[0],
            layer.place[1] + place[:, 2] / clouds.size + left * level * layer.lit_by[2],
            np.full(left.size, layer.place[2] + SLICES[1] * tall),
        )
    )
    side2 = np.maximum(dot(feet[0], feet[0]), dot(feet[1], feet[1])) / 12.0
    penumbra = PENUMBRA * way / math.sqrt(slant)
    width = WIDTH * np.sqrt(side2 + penumbra**2) / clouds.size
    noise, lost = octaves(at, width, (0, SHADOW_OCTAVES), 64 * clouds.seed)
    lost = np.maximum(lost, 0.0)
    passed = layer.passed(noise, lost)
    under = 1.0 - float(smoothstep(0.5, 0.9, layer.eye_y / clouds.height))
    result: Floats = 1.0 + under * clouds.shadows * (passed / max(1.0 - layer.taken, LEAST_PASSED) - 1.0)
    return result
