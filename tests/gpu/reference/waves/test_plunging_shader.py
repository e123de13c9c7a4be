"""Section 17: the shader's section of a plunging crest against float64."""

from pathlib import Path

import numpy as np
import pytest

from support.probe import Probe
from support.scenes import plunging

FILE = f"{Path(plunging.__file__).with_suffix('.glsl')}@section"
NAMES = ("LENGTH", "THROW", "BORE", "LONG", "LANDS", "VERTICAL", "HALF_WIDTH", "HALF_HEIGHT", "XX", "XZ", "ZZ")
CONSTS = {f"PLUNGING_{name}": float(getattr(plunging, name)) for name in NAMES}
NEAR = 2e-6
"""Distance from the curve within which float32 may tell otherwise."""


@pytest.mark.whole
@pytest.mark.parametrize("phase", [0.0, 1e-6, 0.3, 0.8, 1.0])
def test_water_is_where_float64_has_it(phase: float, probe: Probe) -> None:
    random = np.random.default_rng(17)
    curve = plunging.PlungingSection(phase).curve(1000)
    beside = curve.points + random.normal(0.0, 1e-3, (curve.points.shape[0], 1)) * curve.normals
    at = np.concatenate((beside, random.uniform((-4.5, -0.3), (2.0, 1.3), (20000, 2)))).astype(np.float32)
    rows = np.column_stack((at, np.full(len(at), phase, np.float32)))
    got = probe((FILE,), "    y.x = plunging_water(x.xy, x.z) ? 1.0 : 0.0;", rows, consts=CONSTS)[:, 0] > 0.5
    section, (x, z) = plunging.PlungingSection(float(np.float32(phase))), at.astype(np.float64).T
    around = [section.inside(x + dx, z + dz) for dx in (-NEAR, 0.0, NEAR) for dz in (-NEAR, 0.0, NEAR)]
    sure = np.all(around, axis=0) | ~np.any(around, axis=0)
    # Where the jet has no width, all of its thousand points have the face's x.
    assert sure.mean() > 0.97
    np.testing.assert_array_equal(got[sure], section.inside(x, z)[sure])
    assert 0.2 < got.mean() < 0.8
