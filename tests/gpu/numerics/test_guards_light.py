"""Guards of light that no hard case's own pictures show: what functions and finished frames have without them."""

import numpy as np

from seafoam.effects.shader import Inline
from support.probe import Probe, stand_in

FLOOR = "uniform vec3 u_floor_albedo;\nuniform float u_floor_depth;\n"


def test_the_horizon_is_no_heading_straight_down(probe: Probe) -> None:
    got = probe(
        ["lib/numbers.glsl", "light/sky.glsl@analytic"],
        "y.xyz = horizon_light(x.xyz);",
        np.array([[0.0, -1.0, 0.0], [0.0, 1.0, 0.0]], np.float32),
        uniforms={
            "u_sun_direction": (0.6, 0.8, 0.0),
            "u_air_rayleigh": (0.1, 0.1, 0.1),
            "u_air_mie": (0.1, 0.1, 0.1),
            "u_air_even": (0.1, 0.1, 0.1),
            "u_air_horizon": (1.0, 1.0, 1.0),
        },
    )
    assert np.isfinite(got).all()


def test_facets_that_face_away_reflect_no_sun(probe: Probe) -> None:
    got = probe(
        ["lib/numbers.glsl", "lib/refraction.glsl", stand_in("sun"), "light/glitter.glsl@beckmann"],
        "y.xyz = glitter_light(vec3(0.0, -1.0, 0.0), vec3(0.0, -1.0, 0.0), x.x, 1.0);",
        np.array([[1e-3]], np.float32),
        uniforms={"u_sun_direction": (0.0, 1.0, 0.0), "u_sun_irradiance": (1.0, 1.0, 1.0)},
    )
    assert (got[:, :3] == 0.0).all()


def test_light_at_grazing_incidence_comes_from_the_floor_as_along_the_water(probe: Probe) -> None:
    got = probe(
        ["lib/numbers.glsl", "lib/refraction.glsl", Inline(FLOOR), "water/body.glsl@floor"],
        "y.xyz = water_body(vec3(1.0), vec3(0.0), vec3(1.0), x.x, 0.0);",
        np.array([[1.0], [100.0]], np.float32),
        uniforms={"u_floor_albedo": (1.0, 1.0, 1.0), "u_floor_depth": 0.5},
    )
    assert (got[0] == got[1]).all()
