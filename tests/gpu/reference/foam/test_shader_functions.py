"""Every look and saturation of the GLSL against its float64 form, poles included (docs/formulae.md)."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from seafoam.effects.foam.sources import NODES as HEIGHT_NODES
from seafoam.effects.shader import Inline
from seafoam.reference.foam import front
from seafoam.reference.waves import parametric as waves
from seafoam.textures.waves import FRONT_NODES, FrontIntegral, front_fading, front_full
from support.probe import Probe, grid_of

TOLERANCE = 1e-5
POLE = 5e-7
"""Phase, rad: nearer to 0 than 1.9e-7 NVIDIA's sine is 0. The last bit of a phase of 8 rad is as much."""
NUMBERS = "lib/numbers.glsl"
PHASE = ("foam/saturation/front.glsl@own", "foam/saturation/front.glsl@gate", "foam/saturation/front.glsl@profile")
FILTERED_FRONT = (
    NUMBERS,
    Inline("uniform float u_eye_height;"),
    *PHASE,
    "foam/saturation/front.glsl@seen",
    "foam/saturation/front.glsl@filtered",
)
CONSTANTS = {"text": (math.pi / 2, math.e), "listing": (1.07, 2.718)}


def phases() -> NDArray[np.float32]:
    """Phases ψ in [−π, π]: even, and crowding toward the pole at 0 and the ends."""
    even = np.linspace(-math.pi, math.pi, 4001)
    near = np.geomspace(1e-7, 1.0, 400)
    ends = math.pi - np.geomspace(1e-6, 1.0, 200)
    return np.concatenate([even, near, -near, ends, -ends, [0.0]]).astype(np.float32)


def front_of(intensity: float, base: float = math.e, crest: float = 0.5 * math.pi) -> dict[str, dict[str, Any]]:
    """Constants, uniforms and textures of one wave's front, whose k is (1, 0) and phase 0: ψ = −x."""
    log_base = math.log(base)
    return {
        "consts": {
            "FRONT_COUNT": 1,
            "FRONT_GATED": False,
            "FRONT_CREST": crest,
            "FRONT_NODES": FRONT_NODES,
            "FRONT_FULL": front_full(intensity, log_base),
            "FRONT_FADING": front_fading(intensity, log_base),
        },
        "uniforms": {
            "u_front_wave": [1.0, 0.0, 1.0, 0.0],
            "u_front_phase": [0.0],
            "u_front_intensity": intensity,
            "u_front_log_base": log_base,
            "u_front_group": [0.0, 1.0],
        },
        "textures": {"u_front_integral": FrontIntegral(intensity=intensity, log_base=log_base)},
    }


@pytest.mark.parametrize("constants", ["text", "listing"])
@pytest.mark.parametrize("intensity", [0.25, 4.0, 30.0])
def test_front_equals_its_float64_form(probe: Probe, constants: str, intensity: float) -> None:
    _, base = CONSTANTS[constants]
    psi = phases()
    body = "y.x = front_saturation(vec2(-x.x, 0.0), 0.0, Footprint(vec2(0.0), vec2(0.0)));"
    files, given = (NUMBERS, *PHASE, "foam/saturation/front.glsl@plain"), front_of(intensity, base) | {"textures": {}}
    got = probe(files, body, psi[:, None], **given)[:, 0]
    wide = psi.astype(np.float64)
    want = front.front_saturation(np.cos(wide), np.sin(wide), intensity, base)
    want[wide == 0.0] = 4.0
    away = np.abs(got - want)
    # A driver's sine may be 0 so close to the pole: either side's value is right there.
    beside = (wide > -POLE) & (wide < 0.0)
    away[beside] = np.minimum(away[beside], np.abs(got[beside] - 4.0))
    assert away.max() <= TOLERANCE


@pytest.mark.parametrize("intensity", [0.5, 4.0, 30.0])
def test_filtered_front_equals_its_float64_form(probe: Probe, intensity: float) -> None:
    widths = np.array([1e-4, 3e-3, 0.05, 0.1, 0.3, 1.0, 3.0, 6.28, 6.3, 20.0, 1000.0])
    grid = grid_of(phases()[::3], widths)
    got = probe(FILTERED_FRONT, "y.x = front_mean(x.x, x.y);", grid, **front_of(intensity))[:, 0]
    psi, width = grid.astype(np.float64).T
    # A window that just touches the jump covers it by a share of (its float32 edge) / width.
    off = np.abs(got - front.front_saturation_filtered(psi, width, intensity))
    assert (off <= TOLERANCE + 5e-7 / width).all()


@pytest.mark.parametrize("eye_height", [2.0, -0.7, 0.0])
@pytest.mark.parametrize("relief", [0.4, 0.0])
def test_seen_phases_equal_their_float64_form(probe: Probe, eye_height: float, relief: float) -> None:
    rng = np.random.default_rng(12)
    count = 8000
    inputs = np.column_stack(
        [
            10.0 ** rng.uniform(-3.0, 5.0, count),
            rng.choice([-1.0, -0.3, 0.0, 0.02, 1.0], count),
            rng.uniform(-math.pi, math.pi, count),
            10.0 ** rng.uniform(-4.0, 3.0, count),
        ]
    ).astype(np.float32)
    body = "front_seen(vec2(0.6, 0.8) * x.x, 0.25, 0.3 * x.y, 0.3, x.z, x.w);\n y.xy = x.zw;"
    given = front_of(4.0, crest=0.569) | {
        "textures": {},
        "uniforms": {"u_eye_height": eye_height, "u_front_relief": relief},
    }
    got = probe(FILTERED_FRONT, body, inputs, **given)
    away, share, psi, width = inputs.astype(np.float64).T
    change, eye = (0.3 * share, np.full(count, 0.3)), (np.full(count, eye_height - 0.25), away)
    psi_seen, width_seen = front.seen_phases(psi, width, change, eye, float(np.float32(relief)), 0.569)
    off = np.abs(np.remainder(got[:, 0] - psi_seen + math.pi, 2.0 * math.pi) - math.pi)
    assert off.max() <= 5e-5
    assert (np.abs(got[:, 1] - width_seen) <= 5e-5 * width_seen).all()


@pytest.mark.parametrize("kept", [1.0, 0.7, 0.2, 0.0])
def test_seen_height_equals_its_float64_form(probe: Probe, kept: float) -> None:
    """On a level footprint that keeps so much of the waves, from 2 m over places 0.1 to 100 m away."""
    wave = np.float32([0.3, 0.1, 0.5, 2.2])
    seen = np.float32(np.stack((np.linspace(1.5, 0.5, HEIGHT_NODES), np.linspace(0.0, 0.4, HEIGHT_NODES)), axis=1))
    rng = np.random.default_rng(5)
    way, height = 10.0 ** rng.uniform(-1.0, 2.0, 3000), rng.uniform(-0.5, 2.5, 3000)
    x = np.stack((way, height), axis=1).astype(np.float32)
    # As long along the waves as keeps this.
    long = min(math.sqrt(24.0 * -math.log(kept)) if kept > 0.0 else 1e3, 1e3) / float(np.dot(wave[:2], wave[:2]))
    sides = f"vec2({0.3 * long:.9g}, {0.1 * long:.9g}), vec2(0.0)"
    level = f"Footprint level_footprint(vec2 p, float height) {{ return Footprint({sides}); }}"
    got = probe(
        [NUMBERS, Inline("uniform float u_eye_height;"), Inline(level), "foam/saturation/height.glsl@seen"],
        "y.x = height_saturation(vec2(0.6, 0.8) * x.x, x.y, Footprint(vec2(0.0), vec2(0.0)));",
        x,
        consts={"HEIGHT_NODES": HEIGHT_NODES, "SURFACE_FILTER": True},
        uniforms={
            "u_eye_height": 2.0,
            "u_height_base": 0.3,
            "u_height_full": 1.2,
            "u_height_wave": wave,
            "u_height_seen": seen,
        },
    )[:, 0]
    way, height = x.astype(np.float64).T
    base, full = float(np.float32(0.3)), float(np.float32(1.2))
    along = (0.3 * 0.6 + 0.1 * 0.8) / math.hypot(0.3, 0.1)
    fall = np.where(height < 2.0, np.minimum((2.0 - height) / (way * along) * 2.2, 1.0), 1.0)
    at = np.sqrt(fall) * (HEIGHT_NODES - 1)
    mean, deviation = (np.interp(at, np.arange(HEIGHT_NODES), seen[:, i].astype(np.float64)) for i in (0, 1))
    middle = 0.5 + kept * (height - 0.5) + (1.0 - kept) * (mean - 0.5)
    reach = np.maximum(np.sqrt(5.0 * (1.0 - kept**2)) * deviation, 1e-3 * (full - base))
    # Heights that lie under the parabola, by its quantiles.
    y = (np.arange(4000) + 0.5) / 4000
    place = 0.5 - np.sin(np.arcsin(1.0 - 2.0 * y) / 3.0)
    heights = middle[:, None] + reach[:, None] * (2.0 * place - 1.0)
    want = np.clip((heights - base) / (full - base), 0.0, 1.0).mean(axis=1)
    assert np.abs(got - want).max() <= 2e-5


ONE_WAVE = {
    "PARAMETRIC_COUNT": 1,
    "PARAMETRIC_KIND": (0,),
    "PARAMETRIC_ALIKE": True,
    "PARAMETRIC_SIGNAL": False,
    "PARAMETRIC_CARRIES": False,
    "SURFACE_FILTER": False,
}


@pytest.mark.parametrize(
    ("exponent", "kind"),
    [
        *((K, 0) for K in (0.1, 0.3, 0.5, 0.7, 1.0, 1.1, 2.0, 8.0, 8.3, 100.0)),
        *((K, int(2 * K)) for K in (0.5, 1.0, 1.5, 2.0, 3.5, 8.0, 16.0, 16.5)),
    ],
)
def test_wave_profile_equals_its_float64_form(probe: Probe, exponent: float, kind: int) -> None:
    theta = phases()
    got = probe(
        [NUMBERS, "waves/parametric.glsl"],
        "y.xy = parametric_profile(parametric_half(x.x), x.y, PARAMETRIC_KIND[0]);",
        np.column_stack([theta, np.full_like(theta, exponent)]),
        consts={**ONE_WAVE, "PARAMETRIC_KIND": (kind,)},
    )
    wide, power = theta.astype(np.float64), float(np.float32(exponent))
    to_cusp = np.abs(np.sin(wide / 2 + math.pi / 4))

    def off(of: Callable[..., NDArray[np.float64]], column: int) -> tuple[NDArray[np.float64], ...]:
        """By how much it is off, what float32's rounding of the angle may do to the exact profile, and that itself."""
        exact, *near = (of(wide + shift, 1.0, power) for shift in (0.0, -2.4e-7, 2.4e-7))
        return np.abs(got[:, column] - exact), np.abs(np.stack(near) - exact).max(axis=0), np.abs(exact)

    assert np.isfinite(got).all()
    # A power K multiplies relative rounding by 2K.
    height, allowed, _ = off(waves.wave_height, 0)
    allowed = allowed + 5e-7 * (1.0 + power)
    # The cusp itself lies between two float32 angles.
    allowed[to_cusp < 1.2e-7] += (1.2e-7) ** (2.0 * power)
    assert (height <= allowed).all()
    # The slope of a cusp is held within 1e-4 of the trough; elsewhere it is exact to the same measure.
    slope, allowed, steep = off(waves.wave_derivative, 1)
    assert (slope <= allowed + 1e-6 * (1.0 + power) * np.maximum(1.0, steep))[to_cusp > 2e-4].all()
