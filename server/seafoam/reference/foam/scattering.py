"""Section 6: foam as a lumpy layer of bubbles that transmits light and scatters the sun's forward."""

from __future__ import annotations

import math

import numpy as np

from seafoam.reference.light.light import Air, sky_light
from seafoam.reference.types import Floats, dot
from seafoam.scene.foam import FoamScattering

FORWARD = 0.75
"""Asymmetry of the phase function (Henyey and Greenstein 1941)."""
LEAST = 1e-3
"""Least mean cosine of lumps."""


def lumpy_cosine(c: Floats, roughness: float) -> Floats:
    """Mean cosine, 0 where negative, over lumps of the root mean square slope ``roughness`` about the cosine c."""
    result: Floats = np.maximum(0.5 * (c + np.sqrt(c * c + 2.0 / math.pi * roughness**2)), LEAST)
    return result


def layer(
    of: Air,
    scattering: FoamScattering,
    albedo: float,
    n: Floats,
    d: Floats,
    f: Floats,
    past: Floats | None = None,
) -> tuple[Floats, Floats]:
    """Radiance (r, 3) of foam of saturation f (r,) before haze, and its opacity (r,).

    n, d: unit normals and view rays (r, 3). ``past`` (r,): factor on the sun; default: 1.
    """
    eye = lumpy_cosine(-dot(n, d), scattering.roughness)
    sun = lumpy_cosine(dot(n, of.sun), scattering.roughness)
    depth = scattering.optical_depth * np.clip(f, 0.0, 1.0)
    opacity = depth / (depth + 2.0 * eye)
    gamma = d @ of.sun
    phase = (1.0 - FORWARD**2) / (4.0 * math.pi * (1.0 + FORWARD**2 - 2.0 * FORWARD * gamma) ** 1.5)
    matt = (1.0 - scattering.forward) / math.pi
    scattered = sun * (matt + scattering.forward * phase / (sun + eye))
    if past is not None:
        scattered = scattered * past
    light = of.sun_irradiance * scattered[:, None] + sky_light(of, n[:, 1]) / math.pi
    result: Floats = albedo * opacity[:, None] * light
    return result, opacity
