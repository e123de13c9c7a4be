"""Guards on waves, boats and spray that hard cases name and whose pictures cannot show here that they guard."""

import numpy as np
import pytest

from cases.spray import ON_ROCKS, ROCK
from gpu.reference.foam.test_shader_functions import ONE_WAVE
from seafoam.effects.shader import Inline
from seafoam.ocean.waves.cascades import RAISED, cascades
from seafoam.planner import make_plan
from seafoam.planner.glsl import read_file
from seafoam.quality import TIERS
from seafoam.render.gl.executor import Executor
from support.cases import EYE, HardCase
from support.exact import EXACT
from support.hard.guarded import Guarded
from support.hard.pictures import SIZE, truth_of
from support.pictures import draw, draw_target, levels, samples
from support.probe import Probe, stand_in
from support.scenes import Light, Ripples, Scene, Sea, Spray, Water

NUMBERS = "lib/numbers.glsl"


PROFILE = "y.xy = parametric_profile(x.xy, x.z, 0);"
# A ledge of slope x.w before a chasm, under a level ray a millimetre over it.
LEDGE = stand_in("ledge")
REFINED = (
    "slope = x.w;\nfloat tau = x.x;\nfloat gap = x.y;\nvec4 met = field_at(vec2(tau, 0.0));\n"
    "refine(vec2(0.0), 1.0, vec3(1.0, 0.0, 0.0), 1.0, 1e-4, 0.0, int(x.z), false, tau, gap, met);\ny.x = tau;"
)
# A ray 1 m over water of a slope, from 10 m away on.
FROM_MESH = (
    stand_in("water_of_a_slope"),
    Inline(read_file("surface/march.glsl@newton").replace("in vec3 v_position;", "uniform vec3 v_position;")),
)

FUNCTIONS = (
    Guarded(
        "the slope of a cusp in its trough",
        (NUMBERS, "waves/parametric.glsl"),
        PROFILE,
        ((0.0, 1.0, 0.1), (0.0, 158.489)),
        ONE_WAVE,
    ),
    Guarded(
        "a kink in its trough", (NUMBERS, "waves/parametric.glsl"), PROFILE, ((0.0, 1.0, 0.5), (0.0, 0.5)), ONE_WAVE
    ),
    Guarded(
        "the footprint of a ray along the surface",
        (NUMBERS, "lib/rays.glsl@camera"),
        "Footprint fp = footprint(x.xyz, 1.0, vec3(0.0, 1.0, 0.0));\ny.xy = vec2(length(fp.x), length(fp.y));",
        ((0.0, 0.0, -1.0), (1.0, 1000.0)),
        {"u_viewport": (2.0, 2.0), "u_ray_x": (1.0, 0.0, 0.0), "u_ray_y": (0.0, 1.0, 0.0)},
    ),
    Guarded(
        "a step along level water",
        (stand_in("no_short_waves"), "surface/march.glsl@step", "surface/march.glsl@ahead"),
        "y.x = march_ahead(x.yzz, 1.0, x.z, x.z, x.x, x.zzz, x.zz, x.z);",
        ((1e-3, 1.0, 0.0), (1000.0, 0.0)),
    ),
    Guarded("no step behind the eye", (LEDGE, "lib/rays.glsl@newton"), REFINED, ((0.0, -1.0, 1.0, 0.5), (0.0, 0.0))),
    Guarded(
        "steps from the mesh",
        (NUMBERS, *FROM_MESH),
        "float tau;\nvec3 wave;\nfor (int i = 0; i < 2; ++i) {\n    slope = x[i];\n"
        "    find_surface(vec3(1.0, 0.0, 0.0), 1e5, tau, wave);\n    y[i] = tau;\n}",
        ((-1.0, 0.01), (10.0, 10.5)),
        {"REFINE": 1, "v_position": (10.0, 1.0, 0.0), "u_eye_height": 1.0},
    ),
    Guarded(
        "a march from far below",
        (stand_in("still_water"), "surface/march.glsl@march"),
        "vec3 wave;\nbool found = find_surface(x.xyz, 1e5, y.x, wave);",
        ((0.0, -0.5, -1.0), (0.0, 0.0)),
        {
            "MARCH_STEPS": 8,
            "MARCH_STEP_WIDENS": 0.25,
            "MARCH_STEP_WIDEST": 0.0,
            "REFINE": 0,
            "u_eye_height": -1000.0,
            "u_surface_top": 1.0,
            "u_surface_trough": -1.0,
        },
    ),
    # From 5 lengths away, over the sheer and under it; -0 over 0 is what a plane along the ray must not divide.
    Guarded(
        "rays abeam",
        ("boats/hull.glsl@hull",),
        "for (int i = 0; i < 2; ++i) {\n    BoatHit hit = BoatHit(10.0, vec3(0.0), PART_HULL);\n"
        "    hit_hull(vec3(x.z, x[i], -5.0), x.yyw, false, 0.0, hit);\n    y[i] = hit.t;\n}",
        ((0.2, -0.0, -0.12, 1.0), (10.0, 4.8963)),
        {"BOAT_SAILS": True, "BOAT_MOTORS": True},
    ),
)


@pytest.mark.whole
@pytest.mark.parametrize("one", [pytest.param(one, id=one.name) for one in FUNCTIONS])
def test_functions_are_guarded(probe: Probe, one: Guarded) -> None:
    one.check(probe)


def test_newtons_method_takes_no_step_too_far(probe: Probe) -> None:
    """None where the ray is as good as parallel to the surface, and none by far more than the last gap."""
    at = np.array([[1.0, 1e-3, 1.0, 1e-5], [1.0, 1e-3, 2.0, 2e-3]], np.float32)
    np.testing.assert_allclose(probe((LEDGE, "lib/rays.glsl@newton"), REFINED, at)[:, 0], (1.0, 5.5), atol=1e-3)


def test_wakes_at_the_centre_and_on_the_course(probe: Probe) -> None:
    """There is no way round the centre; straight behind a boat waves are as a tenth of a millimetre aside."""
    got = probe(
        (NUMBERS, stand_in("course"), "boats/wake.glsl@way", "boats/wake.glsl@pattern"),
        "WakeWay way = wake_way(0, vec2(0.0));\nvec4 wake = vec4(1.0, 1.0, 100.0, 2.0);\n"
        "y.xy = vec2(length(way.on_behind), length(way.on_aside));\n"
        "y.zw = (wake_pattern(x.xy, wake, 1.0, 30.0) - wake_pattern(x.xz, wake, 1.0, 30.0)).xy;",
        np.array([[5.0, 0.0, 1e-4]], np.float32),
        consts={"BOAT_STEM": 0.5},
        uniforms={"u_boat_course": (0.0, 0.0, 0.0, 30.0), "u_boat_form": (9.0, 0.0, 1.0, 0.0)},
    )
    np.testing.assert_allclose(got, 0.0, atol=1e-3)


def test_no_wave_is_higher_than_the_march_takes_it_to_be(executor: Executor) -> None:
    """Of this sea one crest would be a quarter higher than 4.5 standard deviations."""
    scene = Scene(sea=Sea(wind=60.0, fetch=1e7, choppiness=1.0, seed=4))
    plan = make_plan(scene, EXACT)
    for i, tile in enumerate(cascades(scene.sea, None)[:RAISED]):
        height = draw_target(executor, plan, f"sea_tile_{i}")[..., 0]
        assert np.abs(height).max() <= tile.limit * (1.0 + 1e-6)


def test_sums_of_drops_stay_below_the_greatest_half_float(executor: Executor) -> None:
    bright = Light(sun_elevation=0.5, sun_azimuth=-1.5, exposure=10.0)
    plan = make_plan(Scene(shore=ROCK, spray=Spray(), light=bright), TIERS["standard"])
    shown = plan.model_copy(update={"linear": "spray_thick"})
    got = draw(executor, shown, ON_ROCKS, time=1.2, size=(96, 54), output="linear")
    assert got.max() < 0.5 * 65504.0


def test_no_facet_that_faces_away_glitters(executor: Executor) -> None:
    scene = Scene(water=Water(ripples=Ripples(slope=0.6, spread=0.0)))
    got = samples(executor, scene, EXACT, EYE, time=0.0, size=(96, 54))
    assert got.max() < 1000.0


def test_drops_are_the_references(executor: Executor) -> None:
    """Of a thousandth of a sample: a drop is at least 1.5 samples wide, and hides as much of them."""
    light = Light(sun_elevation=0.5, sun_azimuth=-1.5, exposure=-2.0)
    scene = Scene(shore=ROCK, spray=Spray(size=0.002, mist=0.0), light=light)
    case = HardCase("tiny drops", scene, "", times=(1.2,), camera=ON_ROCKS)
    got = samples(executor, scene, EXACT, ON_ROCKS, time=1.2, size=SIZE)
    away = levels(got, truth_of(executor, case)[0])
    assert away.mean() <= 0.03
    assert (away > 2.0).mean() <= 0.003
