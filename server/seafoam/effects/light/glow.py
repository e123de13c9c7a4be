"""The glow of a lamp in a clear layered sky, as GLSL and its uniforms. docs/formulae.md, section 9."""

import math

import numpy as np

from seafoam.effects.shader import Source
from seafoam.framegraph.rules import Constant, Uniform, array, rounded, vector
from seafoam.ocean.arrays import Floats
from seafoam.ocean.sky import skylight
from seafoam.scene.light import Direction

_SERIES = tuple(f"{part}{tint}{rim}" for rim in ("", "_rim") for part in ("even", "haze") for tint in ("", "_tint"))
_UNIFORMS = ("lamp", "level", *_SERIES)


def glow_source(lamp: str) -> Source:
    """Return the GLSL of ``LAMP_glow(vec3 d)`` and ``LAMP_glow_rim(vec2 level, vec3 d)``."""
    names = tuple((f"u_glow_{name}", f"u_{lamp}_glow_{name}") for name in _UNIFORMS)
    functions = tuple((name, f"{lamp}_{name}") for name in ("glow", "glow_light", "glow_rim"))
    return Source("light/sky.glsl@glow", (*names, *functions))


def glow_uniforms(lamp: str, toward: Direction, glow: skylight.Glow) -> dict[str, Uniform]:
    """Return the uniforms of :func:`glow_source`."""
    level = math.hypot(toward[0], toward[2])
    azimuth = (toward[0] / level, toward[2] / level) if level > 0.0 else (1.0, 0.0)
    series = {
        "even": (skylight.EVEN, glow.even.green),
        "even_tint": (skylight.EVEN_TINT, glow.even.tint),
        "haze": (skylight.HAZE, glow.haze.green),
        "haze_tint": (skylight.HAZE_TINT, glow.haze.tint),
    }
    return {
        f"u_{lamp}_glow_lamp": vector(rounded(toward)),
        f"u_{lamp}_glow_level": vector(rounded(azimuth)),
        **{f"u_{lamp}_glow_{name}": _array(values) for name, (_, values) in series.items()},
        **{f"u_{lamp}_glow_{name}_rim": _array(_along_the_horizon(*both)) for name, both in series.items()},
    }


def _along_the_horizon(exponents: skylight.Exponents, coefficients: Floats) -> Floats:
    """Coefficients of the powers of s where x is 1."""
    every = np.array([j for _, j in exponents])
    return np.stack([coefficients[every == j].sum(axis=0) for j in range(every.max() + 1)])


def _array(values: Floats) -> Uniform:
    """An array of floats, or of vec2 of values (n, 2)."""
    rules = (Constant(value=rounded(values.ravel().tolist())),)
    return array("float" if values.ndim == 1 else "vec2", rules, len(values))
