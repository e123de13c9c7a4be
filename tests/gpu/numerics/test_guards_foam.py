"""Guards on foam that hard cases name and whose pictures cannot show here that they guard."""

import math

import numpy as np
import pytest

from gpu.reference.foam.test_foam_functions import filtered_consts
from gpu.reference.foam.test_shader_functions import FILTERED_FRONT, front_of
from seafoam.effects.foam import front
from seafoam.framegraph.rules import Constant
from seafoam.masks.catalogue import mask_by_name
from seafoam.ocean.foam.whitecaps import whitecap_model
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from support.exact import EXACT
from support.hard.guarded import Guarded
from support.pictures import draw_target
from support.probe import Probe, stand_in
from support.scenes import (
    Drift,
    DriftSaturation,
    Foam,
    FrontSaturation,
    ParametricWave,
    Scene,
    Sea,
    Vortex,
    WhitecapSaturation,
)

NUMBERS = "lib/numbers.glsl"
POINT = "Footprint(vec2(0.0), vec2(0.0))"


FRONT = front_of(4.0)
GIVEN = FRONT["consts"] | FRONT["uniforms"] | FRONT["textures"]
LOOK = (
    NUMBERS,
    "foam/mask.glsl@coordinates",
    stand_in("one_texture"),
    "lib/texels.glsl@cubic_spline",
    "foam/look.glsl@filtered",
)
MASK = mask_by_name("vac-24")
LOWEST = np.unravel_index(int(MASK.ranks.argmin()), MASK.ranks.shape)
ATLAS = {"u_mask_atlas": "mask/vac-24/atlas", "u_mask_quantiles": "mask/vac-24/quantiles"}
NONE = "ShoreField(vec4(0.0, 1.0, 0.0, 0.0), vec4(0.0), vec4(0.0))"
GUARDED = (
    Guarded(
        "a front of no phase",
        (NUMBERS, "foam/saturation/front.glsl@profile"),
        "y.x = front_profile(x.xy, length(x.xy));",
        ((0.0, 0.0), (0.25, 0.0)),
        {"u_front_intensity": 4.0, "u_front_log_base": 1.0},
    ),
    Guarded(
        "a front whose phase turns endlessly fast",
        (
            NUMBERS,
            stand_in("no_phase"),
            "foam/saturation/front.glsl@gate",
            "foam/saturation/front.glsl@seen",
            "foam/saturation/front.glsl@filtered",
        ),
        "y.x = front_saturation(x.xy, 0.0, Footprint(vec2(1.0, 0.0), vec2(0.0)));",
        ((10.0, 0.0), (1.0, 0.0)),
        FRONT["consts"] | {"u_eye_height": 2.0, "u_front_relief": 0.0} | FRONT["textures"],
    ),
    Guarded(
        "a front under a hair",
        FILTERED_FRONT,
        "y.xy = vec2(front_mean(x.x, x.z), front_mean(x.y, x.z));",
        ((2.0, 3.0, 1e-6), (math.exp(1.0 / math.tan(1.0)) / 4.0, math.exp(1.0 / math.tan(1.5)) / 4.0)),
        GIVEN,
    ),
    Guarded(
        "a front as high as the eye",
        FILTERED_FRONT,
        "float psi = 0.5;\nfloat width = 1.0;\nfront_seen(x.xy, x.z, 0.0, 0.3, psi, width);\n"
        "y.xy = vec2(psi, 1e5 * width);",
        ((10.0, 0.0, 2.0), (0.5 * math.pi, 1.0)),
        FRONT["consts"] | {"u_eye_height": 2.0, "u_front_relief": 0.0},
    ),
    Guarded(
        "foam over no height at all",
        (NUMBERS, "foam/saturation/height.glsl@plain"),
        f"y.xy = vec2(height_saturation(vec2(0.0), x.x, {POINT}), height_saturation(vec2(0.0), x.y, {POINT}));",
        ((1.0005, 1.0), (0.5, 0.0)),
        {"u_height_base": 1.0, "u_height_full": 1.0},
    ),
    Guarded(
        "a slope of a wall",
        (NUMBERS, stand_in("given_slope"), "foam/saturation/slope.glsl@lack"),
        f"given = x;\ny.x = slope_lack(vec2(0.0), {POINT});",
        ((0.0, 1e25, 1e25, 0.0), (1.0, 0.0)),
        {"SLOPE_MOST": 1.0},
    ),
    Guarded(
        "a slope that the footprint filters out",
        (NUMBERS, stand_in("given_slope"), "foam/saturation/slope.glsl@lack"),
        f"given = x;\ny.x = slope_lack(vec2(0.0), {POINT});",
        ((0.0, 0.0, 0.0, 3.0), (0.5, 0.0)),
        {"SLOPE_MOST": 1.0},
    ),
    Guarded(
        "whitecaps of nine times",
        (NUMBERS, "foam/saturation/whitecap.glsl@whitecap"),
        "y.x = fold_together(x.x, x.y);",
        ((8.5, 0.0), (1.0, 0.0)),
        {"FOLD_TIMES": 1, "u_whitecap_variance": [1.0, 1.0, 1.0], "u_whitecap_clamped": 0.5},
    ),
    Guarded(
        "the lowest threshold of a mask",
        ("lib/texels.glsl@texel", "foam/mask.glsl@texel_u16"),
        "y.x = 65536.0 * mask_texel(ivec2(x.xy));",
        ((float(LOWEST[1]), float(LOWEST[0])), (0.5, 0.0)),
        {"MASK_SIZE": 512, "u_mask_ranks": "mask/vac-24/ranks"},
    ),
    Guarded(
        "a mask that does not change under a footprint",
        LOOK,
        "uvec2 row = uvec2(0x80008000u);\n"
        "y.x = magnified_coverage(0.5, x.x, row, row, row, row, vec2(0.5), x.yy, x.yy);",
        ((32768.5 / 65536.0 + 2.5e-4, 0.0), (0.75, 0.0)),
        filtered_consts(MASK, 0.0, 1),
    ),
    Guarded(
        "eight tiles of a mask under a footprint",
        LOOK,
        "y.x = filtered_coverage(x.x, 1.0, vec2(0.3, 0.6), vec2(x.y, 0.0), vec2(0.0, x.y));",
        ((0.3, 8.0), (0.3, 0.0)),
        filtered_consts(MASK, 0.0, 1) | ATLAS,
    ),
    Guarded(
        "a footprint without width",
        LOOK,
        "vec2 at = vec2(0.3, 0.6);\ny.x = form_coverage(x.x, at, x.yy, x.yy, x.yy, 0)\n"
        "    / form_coverage(x.x, at, x.yy, x.yy, vec2(0.01), 0);",
        ((0.6, 0.0), (1.0, 0.0)),
        filtered_consts(MASK, 0.0, 1) | ATLAS,
    ),
    Guarded(
        "covers next to whole",
        (NUMBERS, "foam/shading.glsl@cover"),
        "y.xy = vec2(cover_part(cover_free(x.x), x.z), cover_part(cover_free(x.y), x.z));",
        ((0.9999, 1.0, 0.5), (1.0 - 1.2e-4, 1.0)),
    ),
    Guarded(
        "surf on level ground under level water",
        (NUMBERS, "foam/saturation/wake.glsl@torn", stand_in("edge"), "foam/saturation/surf.glsl@front_filtered"),
        f"y.x = surf_at_edge({NONE}, vec4(0.0), x.x, 1.0, 0.0, Footprint(x.yy, x.yy));",
        ((2.5e-4, 0.0), (0.5, 0.0)),
    ),
    Guarded(
        "surf that no way leads from",
        (NUMBERS, "lib/texels.glsl@texel", stand_in("no_field"), "shore/waves.glsl@waves"),
        "y.xy = shore_carried(ShoreField(vec4(0.0, 1.0, 0.0, 0.0), vec4(x.y), vec4(x.y)), x.x);",
        ((0.25, 0.0), (0.0, 0.0)),
        {"SURF": True, "SURFACE_FILTER": False, "PROFILE_ROWS": 2, "PROFILE_NODES": 4},
    ),
    Guarded(
        "a footprint that its shade widens",
        (NUMBERS, stand_in("foam_in_the_sun"), "foam/shading.glsl@beside", "foam/shading.glsl@relief"),
        "foam_relief(1.0, 1.0, vec2(0.0), Footprint(vec2(x.x, 0.0), vec2(0.0, x.x)));\ny.x = widest;",
        ((1e-27,), (0.0, 0.0)),
        {"FOAM_SHADE": 0.6, "u_foam_thickness": 1.0, "u_sun_direction": [0.6, 0.8, 0.0]},
    ),
    Guarded(
        "smooth foam that neither sun nor eye sees",
        (NUMBERS, stand_in("foam_in_the_sun"), "foam/shading.glsl@albedo", "foam/shading.glsl@scattering"),
        "y.x = foam_layer(vec3(0.0, 1.0, 0.0), normalize(x.xyz), 1.0).r;",
        ((1.0, 0.5, 0.0), (0.5 / 1.004, 0.0)),
        {
            "FOAM_ASYMMETRY": 0.0,
            "FOAM_PHASE": 1.0,
            "u_sun_direction": [1.0, 0.0, 0.0],
            "u_sun_irradiance": [1.0] * 3,
            "u_foam_depth": 0.5,
            "u_foam_forward": 1.0,
            "u_foam_albedo": 1.0,
        },
    ),
    Guarded(
        "the centre of a boat's circle",
        (NUMBERS, stand_in("course"), "boats/wake.glsl@way"),
        "WakeWay way = wake_way(0, x.xy);\ny.xy = way.on_behind + way.on_aside;",
        ((3.0, -4.0), (0.0, 0.0)),
        {"BOAT_STEM": 0.5, "u_boat_course": [-3.0, 4.0, 0.0, 10.0], "u_boat_form": [5.0, 0.0, 0.0, 1.0]},
    ),
)


@pytest.mark.whole
@pytest.mark.parametrize("one", [pytest.param(one, id=one.name) for one in GUARDED])
def test_functions_are_guarded(probe: Probe, one: Guarded) -> None:
    one.check(probe)


def test_groups_foam_over_a_range() -> None:
    foam = Foam(saturation=(FrontSaturation(group=(0.5, 0.5)),), look="halftone")
    made = front.EFFECT.contribute(Scene(waves=(ParametricWave(),), foam=foam), EXACT)
    (rule,) = made.uniforms["u_front_group"].rules
    assert isinstance(rule, Constant)
    assert np.float32(rule.value[1]) - np.float32(rule.value[0]) > 9e-5


def test_a_sea_that_is_too_flat_has_no_whitecaps() -> None:
    assert whitecap_model(Sea(wind=0.2, fetch=100.0), WhitecapSaturation(), None, 4, 0.35, 256) is None


def test_foam_closes_before_its_saturation_is_whole(probe: Probe) -> None:
    """Half of what a mask leaves free at 511/512 is covered, so that no hole is left at 1."""
    at = np.random.default_rng(4).random((100_000, 2)).astype(np.float32)
    body = "y.x = filtered_coverage(511.0 / 512.0, 1.0, x.xy, vec2(0.0), vec2(0.0));"
    got = probe(LOOK, body, at, consts=filtered_consts(MASK, 0.0, 1), textures=ATLAS)[:, 0]
    assert got.min() == pytest.approx(0.5, abs=1e-3)


def test_octaves_are_alike_in_every_tile(probe: Probe) -> None:
    """Places of 16 bits, 127 tiles apart: float32 holds them, but not what the octaves make of them."""
    at = np.random.default_rng(4).integers(0, 65536, (4000, 2)) / 65536.0
    body = "y.x = filtered_coverage(0.6, 1.0, x.xy, vec2(1e-5, 0.0), vec2(0.0, 1e-5));"
    ramps = {**ATLAS, "u_mask_quantiles": "mask/vac-24/ramps"}
    consts = filtered_consts(MASK, 0.0, 4)
    here, there = (probe(LOOK, body, at + 127.0 * tile, consts=consts, textures=ramps) for tile in (0, 1))
    assert np.abs(here - there).max() <= 1e-6


def test_foam_that_is_ground_fine_does_not_flicker(executor: Executor) -> None:
    """The oldest generation, which a vortex has wound finer than texels, from one frame to the next."""
    eddy = Vortex(place=(0.0, -6.0), radius=1.2, speed=2.0)
    source = DriftSaturation(life=60.0, patch=1.0)
    drift = Drift(place=(0.0, -10.0), size=40.0, current=(0.0, 0.0), vortices=(eddy,))
    plan = make_plan(
        Scene(drift=drift, foam=Foam(saturation=(source,), mask="clump", mask_tile=4.0)), TIERS["standard"]
    )
    first, second = (draw_target(executor, plan, "drift", time)[..., 3] for time in (50.0, 50.0 + 1.0 / 60.0))
    assert np.abs(first - second).mean() < 1e-4
