"""Every look and saturation of the GLSL against its float64 form, poles included (docs/formulae.md)."""

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import ndimage

from seafoam.effects.effect import Const, Inline
from seafoam.effects.foam.height import NODES as HEIGHT_NODES
from seafoam.effects.foam.height import seen_heights
from seafoam.masks import Mask, mask_by_name
from seafoam.masks.prefilter import OCTAVE_RAMP
from seafoam.ocean.dispersion import wavevector
from seafoam.reference import Assets, sampling
from seafoam.reference.foam import coverage as looked
from seafoam.reference.foam import looks, saturation
from seafoam.reference.waves import parametric as waves
from seafoam.scene.foam import Foam, HeightSaturation
from seafoam.scene.models import Scene
from seafoam.scene.waves import ParametricWave
from seafoam.textures import FRONT_NODES, FrontIntegral, front_fading, front_full
from support.probe import Probe

TOLERANCE = 1e-5
NUMBERS = "lib/numbers.glsl"
PHASE = ("foam/saturation/front_own.glsl", "foam/saturation/front_gate.glsl", "foam/saturation/front_profile.glsl")
FILTERED_FRONT = (
    NUMBERS,
    Inline("uniform float u_eye_height;"),
    *PHASE,
    "foam/saturation/front_seen.glsl",
    "foam/saturation/front_filtered.glsl",
)
CONSTANTS = {"text": (math.pi / 2, math.e), "listing": (1.07, 2.718)}


def phases() -> NDArray[np.float32]:
    """Phases ψ in [−π, π]: even, and crowding toward the pole at 0 and the ends."""
    even = np.linspace(-math.pi, math.pi, 4001)
    near = np.geomspace(1e-7, 1.0, 400)
    ends = math.pi - np.geomspace(1e-6, 1.0, 200)
    return np.concatenate([even, near, -near, ends, -ends, [0.0]]).astype(np.float32)


def front_uniforms(intensity: float, base: float) -> dict[str, object]:
    return {
        "u_front_wave": [1.0, 0.0, 1.0, 0.0],
        "u_front_phase": [0.0],
        "u_front_intensity": intensity,
        "u_front_log_base": math.log(base),
        "u_front_group": [0.0, 1.0],
    }


@pytest.mark.parametrize("constants", ["text", "listing"])
@pytest.mark.parametrize("intensity", [0.25, 4.0, 30.0])
def test_front_equals_its_float64_form(probe: Probe, constants: str, intensity: float) -> None:
    _, base = CONSTANTS[constants]
    psi = phases()
    # One wave with k = (1, 0) and phase 0: psi = -p.x, through every line of the shader.
    got = probe(
        [NUMBERS, *PHASE, "foam/saturation/front.glsl"],
        "y.x = front_saturation(vec2(-x.x, 0.0), 0.0, Footprint(vec2(0.0), vec2(0.0)));",
        psi[:, None],
        consts={"FRONT_COUNT": 1, "FRONT_GATED": False},
        uniforms=front_uniforms(intensity, base),
    )[:, 0]
    wide = psi.astype(np.float64)
    want = saturation.front_saturation(np.cos(wide), np.sin(wide), intensity, base)
    want[wide == 0.0] = 4.0
    assert np.isfinite(got).all()
    assert np.abs(got - want).max() <= TOLERANCE


@pytest.mark.parametrize("constants", ["text", "listing"])
def test_front_is_the_papers_formula(probe: Probe, constants: str) -> None:
    """The literal exp(−tan(θ/2 + δ))/C, on both sides of its pole."""
    delta, base = CONSTANTS[constants]
    pole = math.pi - 2.0 * delta
    theta = np.concatenate([np.linspace(pole + 0.05, pole + 6.2, 2000), pole + np.geomspace(1e-3, 0.05, 100)])
    wrapped = np.arctan2(np.sin(theta + 2 * delta - math.pi), np.cos(theta + 2 * delta - math.pi)).astype(np.float32)
    got = probe(
        [NUMBERS, *PHASE],
        "y.x = front_profile(vec2(cos(x.x), sin(x.x)), 1.0);",
        wrapped[:, None],
        consts={"FRONT_COUNT": 1, "FRONT_GATED": False},
        uniforms=front_uniforms(4.0, base),
    )[:, 0]
    exact = wrapped.astype(np.float64) + math.pi - 2 * delta
    literal = np.minimum(base ** np.clip(-np.tan(exact / 2 + delta), -700, 700) / 4.0, 4.0)
    assert np.abs(got - literal).max() <= TOLERANCE


@pytest.mark.parametrize("intensity", [0.5, 4.0, 30.0])
def test_filtered_front_equals_its_float64_form(probe: Probe, intensity: float) -> None:
    psi = phases()[::3]
    widths = np.array([1e-4, 3e-3, 0.05, 0.1, 0.3, 1.0, 3.0, 6.28, 6.3, 20.0, 1000.0], np.float32)
    grid = np.stack(np.meshgrid(psi, widths), axis=-1).reshape(-1, 2)
    got = probe(
        FILTERED_FRONT,
        "y.x = front_mean(x.x, x.y);",
        grid,
        consts={
            "FRONT_COUNT": 1,
            "FRONT_GATED": False,
            "FRONT_CREST": 0.5 * math.pi,
            "FRONT_NODES": FRONT_NODES,
            "FRONT_FULL": front_full(intensity, 1.0),
            "FRONT_FADING": front_fading(intensity, 1.0),
        },
        uniforms=front_uniforms(intensity, math.e),
        textures={"u_front_integral": FrontIntegral(intensity=intensity, log_base=1.0)},
    )[:, 0]
    wide = grid.astype(np.float64)
    want = saturation.front_saturation_filtered(wide[:, 0], wide[:, 1], intensity)
    assert np.isfinite(got).all()
    # A window that just touches the jump covers it by a share of (its float32 edge) / width.
    allowed = TOLERANCE + 5e-7 / wide[:, 1]
    assert (np.abs(got - want) <= allowed).all()


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
    got = probe(
        FILTERED_FRONT,
        "front_seen(vec2(0.6, 0.8) * x.x, 0.25, 0.3 * x.y, 0.3, x.z, x.w);\n y.xy = x.zw;",
        inputs,
        consts={
            "FRONT_COUNT": 1,
            "FRONT_GATED": False,
            "FRONT_CREST": 0.569,
            "FRONT_NODES": FRONT_NODES,
            "FRONT_FULL": front_full(4.0, 1.0),
            "FRONT_FADING": front_fading(4.0, 1.0),
        },
        uniforms={"u_eye_height": eye_height, "u_front_relief": relief},
    )
    away, share, psi, width = inputs.astype(np.float64).T
    psi_seen, width_seen = saturation.seen_phases(
        psi,
        width,
        0.3 * share,
        np.full(count, 0.3),
        np.full(count, eye_height - 0.25),
        away,
        float(np.float32(relief)),
        0.569,
    )
    assert np.isfinite(got).all()
    turn = 2.0 * math.pi
    off = np.abs(np.remainder(got[:, 0] - psi_seen + math.pi, turn) - math.pi)
    assert off.max() <= 5e-5
    assert (np.abs(got[:, 1] - width_seen) <= 5e-5 * width_seen).all()


def test_heights_that_falling_rays_see() -> None:
    """The running maximum against rays that are followed one by one over the waves."""
    scene = Scene(
        waves=(ParametricWave(amplitude=1.2, wavelength=18.0, exponent=3.0), ParametricWave(wavelength=11.0)),
        foam=Foam(saturation=(HeightSaturation(),)),
    )
    mean, steepest, seen = seen_heights(scene)
    (first, a, m), (second, b, n) = (
        (math.hypot(*wavevector(wave, None)), wave.amplitude, wave.exponent) for wave in scene.waves
    )
    x = np.linspace(0.0, 900.0, 90001)
    h = a * (0.5 + 0.5 * np.cos(first * x)) ** m + b * (0.5 + 0.5 * np.cos(second * x)) ** n
    assert mean == pytest.approx(h.mean(), abs=0.005 * h.max())
    assert seen[0] == (pytest.approx(h.max()), 0.0)
    assert seen[-1] == (pytest.approx(h.mean(), abs=0.005), pytest.approx(h.std(), abs=0.005))
    for i in (2, 4, 8, 12):
        fall = steepest * (i / (HEIGHT_NODES - 1)) ** 2
        over = h + fall * x
        # Rays in even steps: one that comes in so high meets the first place that stands as high.
        rays = np.linspace(h.max(), over[-1] - h.max(), 400)
        met = h[[int(np.argmax(over >= ray)) for ray in rays]]
        assert seen[i][0] == pytest.approx(met.mean(), abs=0.04)
        assert seen[i][1] == pytest.approx(met.std(), abs=0.04)


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
        [NUMBERS, Inline("uniform float u_eye_height;"), Inline(level), "foam/saturation/height_seen.glsl"],
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


def test_torn_steps_are_means_over_what_was_lost(probe: Probe) -> None:
    """A smoothstep of a spread x is a wider one, to a thirtieth; and none lost is none wider."""
    x = np.linspace(-0.5, 1.5, 401, dtype=np.float32)
    for variance in (0.0, 0.002, 0.02):
        got = probe(
            [NUMBERS, "foam/saturation/torn.glsl"], f"y.x = torn_step(0.25, 0.72, x.x, {variance:.9f});", x[:, None]
        )[:, 0]
        spread = np.random.default_rng(1).normal(0.0, math.sqrt(variance), 20000)
        t = np.clip((x[:, None].astype(np.float64) + spread - 0.25) / 0.47, 0.0, 1.0)
        assert np.abs(got - (t * t * (3.0 - 2.0 * t)).mean(axis=1)).max() <= (0.035 if variance else 1e-6)


def test_torn_noise_keeps_what_its_mean_keeps(probe: Probe) -> None:
    """Against value noise averaged over squares: what is kept of it, and what is lost."""
    rng = np.random.default_rng(2)
    cells, fine = 64, 32
    corner = rng.random((cells, cells))
    t = (np.arange(fine) + 0.5) / fine
    t = t * t * (3.0 - 2.0 * t)

    def along(values: NDArray[np.float64]) -> NDArray[np.float64]:
        parts = values[:, None] * (1.0 - t)[:, None] + np.roll(values, -1, axis=0)[:, None] * t[:, None]
        return parts.reshape(-1, values.shape[1])

    noise = along(along(corner).T).T - 0.5
    variance = float((noise**2).mean())
    assert variance == pytest.approx(0.046, rel=0.1)
    sides = (0.125, 0.5, 1.0, 2.0)
    x = np.float32([[side, 0.0] for side in sides])
    got = probe(
        [NUMBERS, "foam/saturation/torn.glsl"],
        "y.xy = torn_noise(vec2(0.5, 0.0), 1.0, 3.0, 1.0, Footprint(vec2(3.0 * x.x, 0.0), vec2(0.0, 3.0 * x.x)));",
        x,
    )
    for (mean, lost), side in zip(got[:, :2], sides, strict=True):
        kept = (mean - 0.5) / 0.5
        box = ndimage.uniform_filter(noise, int(side * fine), mode="wrap")
        assert kept == pytest.approx(float((box * noise).mean()) / variance, abs=0.08)
        assert lost == pytest.approx(0.046 * (1.0 - kept**2), abs=1e-5)


@pytest.mark.parametrize(("file", "cap"), [("height", 4.0), ("height_filtered", 1.0)])
def test_height_equals_its_float64_form(probe: Probe, file: str, cap: float) -> None:
    heights = np.linspace(-3.0, 9.0, 3001, dtype=np.float32)
    got = probe(
        [NUMBERS, f"foam/saturation/{file}.glsl"],
        "y.x = height_saturation(vec2(0.0), x.x, Footprint(vec2(0.0), vec2(0.0)));",
        heights[:, None],
        uniforms={"u_height_base": np.float32(0.3), "u_height_full": np.float32(2.1)},
    )[:, 0]
    want = np.minimum(
        saturation.height_saturation(heights.astype(np.float64), float(np.float32(0.3)), float(np.float32(2.1))), cap
    )
    assert np.abs(got - want).max() <= TOLERANCE


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
        consts={
            "PARAMETRIC_COUNT": 1,
            "PARAMETRIC_KIND": (kind,),
            "PARAMETRIC_ALIKE": True,
            "PARAMETRIC_SIGNAL": False,
            "PARAMETRIC_CARRIES": False,
            "SURFACE_FILTER": False,
        },
    )
    wide, power = theta.astype(np.float64), float(np.float32(exponent))
    assert np.isfinite(got).all()
    height = waves.wave_height(wide, 1.0, power)
    slope = waves.wave_derivative(wide, 1.0, power)
    # What float32's rounding of the angle may do to the exact profile; a power K multiplies relative rounding by 2K.
    near = [waves.wave_height(wide + shift, 1.0, power) for shift in (-2.4e-7, 2.4e-7)]
    allowed = np.maximum(np.abs(near[0] - height), np.abs(near[1] - height)) + 5e-7 * (1.0 + power)
    # The cusp itself lies between two float32 angles.
    allowed[np.abs(np.sin(wide / 2 + math.pi / 4)) < 1.2e-7] += (1.2e-7) ** (2.0 * power)
    assert (np.abs(got[:, 0] - height) <= allowed).all()
    # The slope of a cusp is held within 1e-4 of the trough; elsewhere it is exact to the same measure.
    clear = np.abs(np.sin(wide / 2 + math.pi / 4)) > 2e-4
    near = [waves.wave_derivative(wide + shift, 1.0, power) for shift in (-2.4e-7, 2.4e-7)]
    allowed = np.maximum(np.abs(near[0] - slope), np.abs(near[1] - slope)) + 1e-6 * (1.0 + power) * np.maximum(
        1, abs(slope)
    )
    assert (np.abs(got[:, 1] - slope) <= allowed)[clear].all()


def test_a_wave_under_a_footprint_is_its_mean_over_the_box(probe: Probe) -> None:
    """By its two sides a box averages a wave by sin(a/2)/(a/2) each; the Gaussian has as much variance."""
    sides = grid_of(np.linspace(0.0, math.pi, 33), np.linspace(0.0, math.pi, 33))
    kept = probe([NUMBERS], "y.x = wave_kept(dot(x.xy, x.xy));", sides)[:, 0]
    a, b = 0.5 * sides.astype(np.float64).T
    mean = np.sinc(a / math.pi) * np.sinc(b / math.pi)
    assert np.abs(kept - mean).max() <= 0.035
    small = (sides**2).sum(axis=-1) <= 1.0
    assert np.abs(kept - mean)[small].max() <= 4e-4
    # What is far larger than the wave leaves nothing of it, and is no underflow.
    wide = probe([NUMBERS], "y.x = wave_kept(x.x);", np.array([[1e3], [1e30], [3e38]], np.float32))[:, 0]
    assert (wide >= 0.0).all()
    assert wide.max() <= 1e-18


def grid_of(*axes: NDArray[np.float64]) -> NDArray[np.float32]:
    return np.stack(np.meshgrid(*axes), axis=-1).reshape(-1, len(axes)).astype(np.float32)


HARD = {
    "textured": lambda f, m, t: looks.textured(f, t),
    "halftone": lambda f, m, t: looks.halftone(f, m),
    "fading": lambda f, m, t: looks.fading(f, m),
    "halftone_textured": looks.halftone_textured,
    "listing": looks.listing,
}


@pytest.mark.parametrize("look", HARD)
def test_look_equals_its_float64_form(probe: Probe, look: str) -> None:
    """The look's file with the mask and the texture replaced by inputs."""
    values = grid_of(
        np.concatenate([[0.0, 1e-6, 4.0], np.linspace(0, 4, 81)]),
        np.concatenate([[0.5 / 262144, 1 - 0.5 / 262144], np.linspace(0.01, 0.99, 50)]),
        np.linspace(0, 1, 6),
    )
    stand_ins = Inline(
        "vec4 given;\n"
        "float mask_threshold(vec2 p) {\n    return given.y;\n}\n"
        "float foam_texture(vec2 p, Footprint fp) {\n    return given.z;\n}\n"
    )
    got = probe(
        [NUMBERS, stand_ins, f"foam/look/{look}.glsl"],
        "given = x;\n y.x = foam_amount(x.x, vec2(0.0), Footprint(vec2(0.0), vec2(0.0)));",
        values,
    )[:, 0]
    f, m, t = values.astype(np.float64).T
    assert np.abs(got - HARD[look](f, m, t)).max() <= TOLERANCE


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


@pytest.mark.parametrize("mask_name", ["vac-1.5", "vac-24", "mix"])
@pytest.mark.parametrize("fade", [0.0, 0.3])
def test_filtered_coverage_equals_its_float64_form(probe: Probe, mask_name: str, fade: float) -> None:
    mask = mask_by_name(mask_name)
    rng = np.random.default_rng(5)
    count = 6000
    texels = 2.0 ** rng.uniform(-6, 7, count)
    inputs = np.column_stack(
        [rng.choice([0.0, 1e-3, 0.02, 0.3, 0.6, 0.97, 1.0], count), rng.random(count), rng.random(count), texels / 512]
    ).astype(np.float32)
    got = probe(
        [
            NUMBERS,
            "foam/mask_coordinates.glsl",
            Inline("float foam_texture(vec2 p, Footprint fp) {\n    return 1.0;\n}\n"),
            "foam/look/filtered.glsl",
        ],
        "y.x = filtered_coverage(x.x, 1.0, x.yz, vec2(x.w, 0.0), vec2(0.3 * x.w, 0.8 * x.w));",
        inputs,
        consts=filtered_consts(mask, fade, 1),
        uniforms={"u_foam_fade": fade},
        textures={
            "u_mask_atlas": f"mask/{mask_name}/atlas",
            "u_mask_quantiles": f"mask/{mask_name}/quantiles",
        },
    )[:, 0]
    s, u, v, w = inputs.astype(np.float64).T
    foot_u, foot_v = np.column_stack([w, 0 * w]), np.column_stack([0.3 * w, 0.8 * w])
    size = 512.0 * np.hypot(foot_u, foot_v)
    assets = sixteen_bits(mask)
    _, e = looks.spline_over_footprint(sampling.bspline(assets.thresholds, u, v), foot_u, foot_v)
    want = looked.covered(assets, s, u, v, foot_u, foot_v, float(np.float32(fade)))
    half = np.where(looks.minification(size) < 1.0, np.maximum(e, 5e-4), 0.05)
    assert np.isfinite(got).all()
    assert (got[s == 0.0] == 0.0).all()
    if fade == 0.0:
        assert (got[s == 1.0] == 1.0).all()
    # The quotient by 2 half spreads float32's rounding of the thresholds.
    assert (np.abs(got - want) <= TOLERANCE + 2e-6 / half).all()
    assert (half > 0.04).sum() > 1000


@pytest.mark.parametrize("fade", [0.0, 0.4])
@pytest.mark.parametrize("octaves", [2, 4])
def test_octaves_equal_their_float64_form(probe: Probe, octaves: int, fade: float) -> None:
    mask = mask_by_name("lace")
    rng = np.random.default_rng(9)
    count = 6000
    texels = 2.0 ** rng.uniform(-9, 7, count)
    # Places of 16 bits: the Gaussian integer multiplies them without rounding.
    u, v = rng.integers(0, 65536, (2, count)) / 65536.0
    s = rng.choice([0.0, 1e-3, 0.02, 0.3, 0.6, 0.97, 1.0], count)
    inputs = np.column_stack([s, u, v, texels / 512]).astype(np.float32)
    stand_in = Inline(
        "vec4 given;\nvec2 mask_uv(vec2 p) {\n    return given.yz;\n}\nvec2 mask_turn(vec2 p) {\n    return p;\n}\n"
    )
    texture = Inline("float foam_texture(vec2 p, Footprint fp) {\n    return 1.0;\n}\n")
    got = probe(
        [NUMBERS, stand_in, texture, "foam/look/filtered.glsl"],
        "given = x; y.x = foam_amount(x.x, vec2(0.0), Footprint(vec2(x.w, 0.0), vec2(0.3 * x.w, 0.8 * x.w)));",
        inputs,
        consts=filtered_consts(mask, fade, octaves),
        uniforms={"u_foam_fade": fade},
        textures={"u_mask_atlas": "mask/lace/atlas", "u_mask_quantiles": "mask/lace/ramps"},
    )[:, 0]
    s, u, v, w = inputs.astype(np.float64).T
    foot_u, foot_v = np.column_stack([w, 0 * w]), np.column_stack([0.3 * w, 0.8 * w])
    assets = sixteen_bits(mask)
    foam = Foam(octaves=octaves, fade=float(np.float32(fade)))
    want = looked.coverage(foam, assets, s, u, v, foot_u, foot_v, filtering=True)
    assert np.isfinite(got).all()
    assert (got[s == 0.0] == 0.0).all()
    if fade == 0.0:
        assert (got[s == 1.0] == 1.0).all()
    # Next to none and next to all a ramp stands on a root of the share, and spreads what the octave before rounded.
    off = np.abs(got - want)
    assert np.quantile(off, 0.98) <= 1e-5
    assert off.max() <= 2e-3
    # Near the eye most is whole or clear.
    near = (texels < 2.0**-7) & (np.abs(s - 0.6) < 1e-6)
    assert near.sum() > 50
    assert ((got[near] == 0.0) | (got[near] == 1.0)).mean() > (0.5 if octaves == 4 else 0.3)
