"""Functions of shaders/ that foam looks by: coverage of masks, octaves, torn steps, against float64."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.effects.shader import Const
from seafoam.masks.catalogue import Mask, mask_by_name
from seafoam.masks.prefilter import OCTAVE_RAMP
from seafoam.reference import Assets, sampling
from seafoam.reference.foam import coverage as looked
from seafoam.reference.foam import looks
from support.parity import HARD
from support.probe import Probe, grid_of, stand_in
from support.scenes import Foam, Look

TOLERANCE = 1e-5
NUMBERS = "lib/numbers.glsl"


@pytest.mark.parametrize("look", ["textured", *HARD])
def test_look_equals_its_float64_form(probe: Probe, look: Look) -> None:
    """The look's file with the mask and the texture replaced by inputs."""
    values = grid_of(
        np.concatenate([[0.0, 1e-6, 4.0], np.linspace(0, 4, 81)]),
        np.concatenate([[0.5 / 262144, 1 - 0.5 / 262144], np.linspace(0.01, 0.99, 50)]),
        np.linspace(0, 1, 6),
    )
    got = probe(
        [NUMBERS, stand_in("given_look"), f"foam/look.glsl@{look}"],
        "given = x;\n y.x = foam_amount(x.x, vec2(0.0), Footprint(vec2(0.0), vec2(0.0)));",
        values,
    )[:, 0]
    f, m, t = values.astype(np.float64).T
    assert np.abs(got - looks.hard(look, f, m, t)).max() <= TOLERANCE


def filtered_consts(mask: Mask, fade: float, octaves: int) -> dict[str, Const]:
    """Compile-time numbers of the filtered look, 512 texels a side, 16 of them a footprint."""
    return {
        "MASK_SIZE": 512,
        "MASK_LEVELS": 10,
        "QUANTILES": len(mask.quantile),
        "FOAM_FADES": fade > 0,
        "FOAM_OCTAVES": octaves,
        "OCTAVE_RAMP": OCTAVE_RAMP,
        "FOAM_TEXTURED": False,
        "FOAM_SIDE": 4,
        "FOAM_LIVES": False,
        "FOAM_MASKS": 1,
        "MASK_ROWS": 10 + (2 if octaves > 1 else 1),
    }


def sixteen_bits(mask: Mask) -> Assets:
    """What the filtered look reads: the spline has 16 bits of each threshold."""
    return replace(Assets.of(mask, np.ones((1, 1))), thresholds=((mask.ranks >> 2) + 0.5) / 65536.0)


def looked_at(probe: Probe, name: str, fade: float, octaves: int, inputs: NDArray[np.float32]) -> NDArray[np.float32]:
    """The filtered look of a mask: saturation, place and footprint of ``inputs``, which a texel share x.w widens."""
    mask, footprint = mask_by_name(name), "vec2(x.w, 0.0), vec2(0.3 * x.w, 0.8 * x.w)"
    if octaves == 1:
        files, body = (
            ("foam/mask.glsl@coordinates", stand_in("one_texture")),
            f"filtered_coverage(x.x, 1.0, x.yz, {footprint})",
        )
    else:
        files, body = (stand_in("given_mask"),), f"foam_amount(x.x, vec2(0.0), Footprint({footprint}))"
    table = "quantiles" if octaves == 1 else "ramps"
    got = probe(
        (NUMBERS, *files, "lib/texels.glsl@cubic_spline", "foam/look.glsl@filtered"),
        f"{'' if octaves == 1 else 'given = x; '}y.x = {body};",
        inputs,
        consts=filtered_consts(mask, fade, octaves),
        uniforms={"u_foam_fade": fade},
        textures={"u_mask_atlas": f"mask/{name}/atlas", "u_mask_quantiles": f"mask/{name}/{table}"},
    )[:, 0]
    s = inputs[:, 0]
    assert np.isfinite(got).all()
    assert (got[s == 0.0] == 0.0).all()
    if fade == 0.0:
        assert (got[s == 1.0] == 1.0).all()
    return got


def places(inputs: NDArray[np.float32]) -> tuple[NDArray[np.float64], looked.MaskPoints]:
    """Saturations of ``inputs``, and their places and footprints for the reference."""
    s, u, v, w = inputs.astype(np.float64).T
    return s, looked.MaskPoints(u, v, np.column_stack([w, 0 * w]), np.column_stack([0.3 * w, 0.8 * w]))


@pytest.mark.parametrize("mask_name", ["vac-1.5", "vac-24", "mix"])
@pytest.mark.parametrize("fade", [0.0, 0.3])
def test_filtered_coverage_equals_its_float64_form(probe: Probe, mask_name: str, fade: float) -> None:
    rng, count = np.random.default_rng(5), 6000
    texels = 2.0 ** rng.uniform(-6, 7, count)
    s = rng.choice([0.0, 1e-3, 0.02, 0.3, 0.6, 0.97, 1.0], count)
    inputs = np.column_stack([s, rng.random(count), rng.random(count), texels / 512]).astype(np.float32)
    got = looked_at(probe, mask_name, fade, 1, inputs)
    (s, at), assets = places(inputs), sixteen_bits(mask_by_name(mask_name))
    size = 512.0 * np.hypot(at.foot_u, at.foot_v)
    _, e = looks.spline_over_footprint(sampling.bspline(assets.thresholds, at.u, at.v), at.foot_u, at.foot_v)
    half = np.where(looks.minification(size) < 1.0, np.maximum(e, 5e-4), 0.05)
    # The quotient by 2 half spreads float32's rounding of the thresholds.
    off = np.abs(got - looked.covered(assets, s, at, float(np.float32(fade))))
    assert (off <= TOLERANCE + 2e-6 / half).all()
    assert (half > 0.04).sum() > 1000


@pytest.mark.parametrize("fade", [0.0, 0.4])
@pytest.mark.parametrize("octaves", [2, 4])
def test_octaves_equal_their_float64_form(probe: Probe, octaves: int, fade: float) -> None:
    rng, count = np.random.default_rng(9), 6000
    texels = 2.0 ** rng.uniform(-9, 7, count)
    # Places of 16 bits: the Gaussian integer multiplies them without rounding.
    u, v = rng.integers(0, 65536, (2, count)) / 65536.0
    s = rng.choice([0.0, 1e-3, 0.02, 0.3, 0.6, 0.97, 1.0], count)
    inputs = np.column_stack([s, u, v, texels / 512]).astype(np.float32)
    got = looked_at(probe, "lace", fade, octaves, inputs)
    s, at = places(inputs)
    foam = Foam(octaves=octaves, fade=float(np.float32(fade)))
    want = looked.coverage(foam, sixteen_bits(mask_by_name("lace")), s, at, filtering=True)
    # Next to none and next to all a ramp stands on a root of the share, and spreads what the octave before rounded.
    off = np.abs(got - want)
    assert np.quantile(off, 0.98) <= 1e-5
    assert off.max() <= 2e-3
    # Near the eye most is whole or clear.
    near = (texels < 2.0**-7) & (np.abs(s - 0.6) < 1e-6)
    assert near.sum() > 50
    assert ((got[near] == 0.0) | (got[near] == 1.0)).mean() > (0.5 if octaves == 4 else 0.3)
