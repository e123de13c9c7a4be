"""Of the water's body, caustics, the view from below, shores, shadows of land, cube maps and planar mirrors."""

from support.hard.mutations import IN_FLOAT32, Mutation

_GUARDS = "tests/gpu/numerics/test_guards_ground.py::"

MUTATIONS = {
    "eye on the surface": (Mutation("surface/march.glsl", (("u_eye_height * ray.y >= 0.0", "ray.y >= 0.0"),)),),
    "no scattering, no roughness to speak of": (
        Mutation(
            "scene/water.py",
            (("default=0.05,\n        ge=0.01", "default=0.05,\n        ge=0.0"),),
            test=f"{_GUARDS}test_water_at_the_ends_of_its_fields[roughness-minimum]",
        ),
    ),
    "the horizon exactly in the middle": (Mutation("surface/march.glsl", (("u_eye_height * ray.y >= 0.0", "false"),)),),
    "the floor in the focus": (
        Mutation(
            "water/caustics.glsl",
            (("max(abs(a.x * b.y - a.y * b.x), 1.0 / CAUSTIC_MOST)", "abs(a.x * b.y - a.y * b.x)"),),
            test=f"{_GUARDS}test_a_grid_is_no_brighter_in_a_focus_than_photons",
        ),
    ),
    "caustics of a sun on the horizon": (
        Mutation("water/caustics.glsl", (("max(u_sun_direction.y, 0.05)", "u_sun_direction.y"),)),
    ),
    "caustics of the steepest ripples": (Mutation("water/caustics.glsl", (("max(-ray.y, 0.25)", "-ray.y"),)),),
    "caustics after thirty years, ten thousand kilometres away": IN_FLOAT32,
    "colours as far apart as they go": (
        Mutation(
            "effects/water/caustics.py",
            (("margin = tile.margin(cells)", "margin = 0"),),
            test="tests/gpu/reference/light/test_caustics.py::test_no_seam_shows[caustics_cells-grid]",
        ),
    ),
    "past the critical angle": (Mutation("water/underside.glsl", (("sqrt(max(out2, 0.0))", "sqrt(out2)"),)),),
    "straight up, where light and sight fade alike": (
        Mutation("water/underside.glsl", (("max(1.0 + fall, 1e-3)", "1.0 + fall"),)),
    ),
    "a hair under the surface": (Mutation("water/underside.glsl", (("max(so_far, 1e-3)", "so_far"),)),),
    "an eye under the floor": (
        Mutation("water/seafloor.glsl", (("max(u_floor_depth + y, 0.0)", "(u_floor_depth + y)"),)),
    ),
    "an eye in a crest, below": (
        Mutation(
            "water/underside.glsl",
            (
                ("tau = max(u_surface_trough - u_eye_height, 0.0)", "tau = (u_surface_trough - u_eye_height)"),
                ("tau = max(tau, march_start(ray).r)", "tau = tau"),
            ),
        ),
    ),
    "straight up from before a beach": (
        Mutation(
            "shore/march.glsl",
            (("max(u_shore_steepest[0] * level - ray.y, slowest)", "u_shore_steepest[0] * level - ray.y"),),
        ),
    ),
    "along the slope of a beach, a hand over it": (
        Mutation("lib/rays.glsl", (("if (rate < -slowest)", "if (true)"),)),
    ),
    "all land": (
        Mutation(
            "shore/maps.glsl",
            (("other.x < 0.0 ? u_viewport.x : length(other - at) - 0.5", "length(other - at) - 0.5"),),
            test="tests/gpu/reference/shore/test_shore.py::test_distances_are_scipys",
        ),
    ),
    "all water, a bank two metres down": (
        Mutation(
            "shore/maps.glsl",
            (("other.x < 0.0 ? u_viewport.x : length(other - at) - 0.5", "length(other - at) - 0.5"),),
        ),
    ),
    "an island of one texel": (
        Mutation(
            "shore/maps.glsl",
            (("smooth_between(0.3, 0.8, steep)", "1.0"),),
            test="tests/gpu/reference/shore/test_shore.py::test_the_map_is_the_references[0.0-False-islands]",
        ),
    ),
    "water a hand deep and a beach as level": (
        Mutation(
            "shore/maps.glsl",
            (
                ("max(0.3 * u_surf_height, 0.05)", "0.3 * u_surf_height"),
                ("max(u_surf_height, 0.05)", "u_surf_height"),
            ),
            test=f"{_GUARDS}test_a_shore_without_surf_has_a_finite_map",
        ),
    ),
    "waves of no skew and of all of it": (
        Mutation(
            "textures/shore.py",
            (("np.fft.irfft(np.fft.rfft(top) * spread, fine)", "top"),),
            test=f"{_GUARDS}test_fronts_are_no_steeper_than_a_smoothed_step",
        ),
    ),
    "the clearest water": (
        Mutation(
            "scene/water.py",
            (("Field(ge=0.01, le=1000.0)", "Field(ge=0.01, le=1e38)"),),
            test=f"{_GUARDS}test_water_at_the_ends_of_its_fields[absorption_length-maximum]",
        ),
    ),
    "ripples that face away": (
        Mutation(
            "shore/floor.glsl",
            (("max(-r.y, 0.25)", "-r.y"),),
            test=f"{_GUARDS}test_functions_are_guarded[way through ripples that face the eye]",
        ),
    ),
    "straight down on the water's edge": (
        Mutation(
            "shore/ground.glsl",
            (("abs(way.x) < 1e-9 ? 1e-9 : way.x", "way.x"), ("abs(way.y) < 1e-9 ? 1e-9 : way.y", "way.y")),
            test=f"{_GUARDS}test_functions_are_guarded[span along the square's edge]",
        ),
    ),
    "a shore ten thousand kilometres away, after thirty years": IN_FLOAT32,
    "a swell that the depth bends, over a beach all but level": (
        Mutation("ocean/coast/travel.py", (("np.maximum(depth, least)", "np.maximum(depth, 0.0)"),)),
    ),
    "eye inside a hill": (
        Mutation(
            "shore/ground.glsl",
            (("max(max(min(one.x, two.x), min(one.y, two.y)), 0.0)", "max(min(one.x, two.x), min(one.y, two.y))"),),
            test=f"{_GUARDS}test_functions_are_guarded[span from inside]",
        ),
    ),
    "eye under water": (
        Mutation(
            "shore/land.glsl",
            (
                ("if (enter >= leave)", "if (false)"),
                ("tau < leave && gap < -fine * tau", "gap < -fine * tau"),
                ("if (tau >= leave || gap >= fine * tau)", "if (gap >= fine * tau)"),
            ),
            test=f"{_GUARDS}test_functions_are_guarded[search that ends before it starts]",
        ),
    ),
    "shadow of an island under a sun that touches the horizon": (
        Mutation(
            "effects/shore/shadow.py",
            (("max(math.tan(lower), LOWEST_RISE)", "math.tan(lower)"),),
            test=f"{_GUARDS}test_shadows_of_land_end[0.004-20000.0]",
        ),
    ),
    "shadow of an island under a sun in the zenith": (
        Mutation(
            "effects/shore/shadow.py",
            (
                ("max(math.hypot(x, z), 1e-6)", "math.hypot(x, z)"),
                ("min(elevation + SUN_RADIUS, 1.5)", "elevation + SUN_RADIUS"),
                ("min(elevation - SUN_RADIUS, 1.49)", "elevation - SUN_RADIUS"),
            ),
        ),
    ),
    "shadow of an island across the edge of its square": (
        Mutation(
            "shore/sunlit.glsl",
            (("float way = max(enters.x, enters.y)", "float way = 0.0"),),
            test=f"{_GUARDS}test_shadows_of_land_end[0.05-2000.0]",
        ),
    ),
    "shadow along an axis of the square": (
        Mutation(
            "shore/sunlit.glsl",
            (("max(abs(u_land_sun.xy), 1e-6)", "abs(u_land_sun.xy)"),),
            test=f"{_GUARDS}test_functions_are_guarded[sun along an axis, beside the square]",
        ),
    ),
    "a mirror with nothing to mirror": (
        Mutation(
            "effects/reflection/cubemap.py",
            (
                (
                    '("reflection/mirror.glsl@open",)',
                    '(*SHORE, *lit_land(shore or Shore()), "reflection/mirror.glsl@land_around")',
                ),
            ),
            error="u_land_detail has no rule",
        ),
    ),
    "the cube map's own corners and edges": (
        Mutation(
            "reflection/cube.glsl",
            (("min(ivec2(at), ivec2(CUBE_SIZE - 2))", "ivec2(at)"),),
            test=f"{_GUARDS}test_functions_are_guarded[texels of a cube]",
        ),
    ),
    "the middle of the cube map inside a hill": (
        Mutation(
            "reflection/mirror.glsl",
            (("max(AROUND_HEIGHT, shore_floor(eye).x + AROUND_HEIGHT)", "AROUND_HEIGHT"),),
        ),
    ),
    "a mirror under the eye and straight down": (
        Mutation(
            "reflection/mirror.glsl",
            (("if (depth < 1e-3)", "if (false)"),),
            test=f"{_GUARDS}test_functions_are_guarded[mirror of what is behind]",
        ),
    ),
    "a mirror at grazing, eye among crests": (
        Mutation("surface/main.glsl", (("vec3(p.x, u_eye_height + tau * ray.y, p.y)", "vec3(p.x, 0.0, p.y)"),)),
    ),
}

UNSEEN = {
    "distances without any smoothing": "Mesa takes a constant 0 over anything for 0, which the guard gives",
    "water as rough as it gets, a hundred kilometres up": "not needed: what footprints leave of a band is in [0, 1]",
    "smooth land": "not needed: neither octaves nor a film of water are in the program",
    "rugged land of full detail, seen along the ground": "llvmpipe's max(NaN, x) is x, which is what the guard gives",
}
