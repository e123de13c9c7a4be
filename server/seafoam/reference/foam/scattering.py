"""Section 6: foam as a lumpy layer of bubbles that transmits light and scatters the sun's forward."""

from __future__ import annotations

import math

import numpy as np

from seafoam.reference.light.light import Air, Share, sky_light
from seafoam.reference.types import Floats, dot, henyey_greenstein
from seafoam.scene.foam import FoamScattering

FORWARD = 0.75
"""Asymmetry of the phase function (Henyey and Greenstein 1941)."""
LEAST = 1e-3
"""Least mean cosine of lumps."""


def lumpy_cosine(c: Floats, roughness: float) -> Floats:
    """Mean cosine, 0 where negative, over lumps of the root mean square slope ``roughness`` about the cosine c."""
    return np.maximum(0.5 * (c + np.sqrt(c * c + 2.0 / math.pi * roughness**2)), LEAST)


def layer(
    air: Air, scattering: FoamScattering, albedo: float, n: Floats, d: Floats, f: Floats, sun: Share = 1.0
) -> tuple[Floats, Floats]:
    """Radiance (r, 3) of foam of saturation f (r,) before haze, and its opacity (r,).

    n, d: unit normals and view rays (r, 3). ``sun``: what is left of the sunlight.
    """
    toward_eye = lumpy_cosine(-dot(n, d), scattering.roughness)
    toward_sun = lumpy_cosine(dot(n, air.sun), scattering.roughness)
    depth = scattering.optical_depth * np.clip(f, 0.0, 1.0)
    opacity = depth / (depth + 2.0 * toward_eye)
    phase = henyey_greenstein(FORWARD, d @ air.sun)
    matt = (1.0 - scattering.forward) / math.pi
    scattered = toward_sun * (matt + scattering.forward * phase / (toward_sun + toward_eye)) * sun
    light = air.sun_irradiance * scattered[:, None] + sky_light(air, n[:, 1]) / math.pi
    result: Floats = albedo * opacity[:, None] * light
    return result, opacity
