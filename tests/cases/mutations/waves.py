"""Of waves, rings, ripples, the sea, boats and spray."""

from support.hard.mutations import Mutation

_RULES = "framegraph/evaluation.py"
_TIME = Mutation(_RULES, (("state.time", "np.float32(state.time)"),))
_PLACE = Mutation(_RULES, (("x, _, z = state.camera.position", "x, _, z = np.float32(state.camera.position)"),))

_GUARDS = "tests/gpu/numerics/test_guards_waves.py"


def _function(name: str) -> str:
    """The test of a function of ``shaders/`` at one place."""
    return f"{_GUARDS}::test_functions_are_guarded[{name}]"


_WAKE_EDGE = Mutation("boats/wake.glsl", (("at.x <= 0.0 || square <= 0.0", "at.x <= 0.0"),))

_PARAMETRIC = {
    "a cusp in every trough, K 0.1": (
        Mutation(
            "waves/parametric.glsl",
            (("max(q, exponent < 0.5 ? 1e-4 : 1e-30)", "q"),),
            test=_function("the slope of a cusp in its trough"),
        ),
    ),
    "0^K, K 100, and kinks, K 0.5 and 0.7": (
        Mutation(
            "waves/parametric.glsl",
            (("max(q, exponent < 0.5 ? 1e-4 : 1e-30)", "q"),),
            test=_function("a kink in its trough"),
        ),
    ),
    "any time, waves of 5 cm": (_TIME,),
    "ten thousand kilometres from the origin": (_PLACE,),
    "opposite waves that cancel": (
        Mutation(
            "foam/saturation/front.glsl",
            (("return FRONT_GATED ? smoothstep(u_front_group.x, u_front_group.y, rho) : 1.0;", "return 1.0;"),),
        ),
    ),
    "sixteen equal waves": (
        Mutation("surface/march.glsl", (("(now.x - less.x) * speed", "0.06 * (now.x - less.x) * speed"),)),
    ),
    "a wall of water, 50 m high and 5 cm long": (
        Mutation(
            "lib/rays.glsl",
            (("min(dot(normal, ray), -1e-3 * length(normal) * length(ray))", "dot(normal, ray)"),),
            test=_function("the footprint of a ray along the surface"),
        ),
    ),
    "as good as flat": (
        Mutation(
            "surface/march.glsl",
            (("max((now.x - less.x) * speed - ray.y, 1e-6 * length(ray))", "(now.x - less.x) * speed - ray.y"),),
            test=_function("a step along level water"),
        ),
    ),
    "two kilometres long in 5 cm of water": (
        Mutation(
            "ocean/basics/dispersion.py",
            (("k = deep / math.sqrt(math.tanh(deep * depth))", "k = deep"), ("range(30)", "range(3)")),
        ),
    ),
    "a grazing ray over steep crests": (
        Mutation(
            "lib/rays.glsl",
            (("rate < -slowest", "rate < 0.0"), ("clamp(gap / rate, -limit, limit)", "gap / rate")),
            test=f"{_GUARDS}::test_newtons_method_takes_no_step_too_far",
        ),
    ),
    "rays that double back on the mesh": (
        Mutation(
            "surface/march.glsl",
            (("if (rate < -1e-3 * length(ray)) {", "{"), ("clamp(gap / rate, -limit, limit)", "gap / rate")),
            test=_function("steps from the mesh"),
        ),
    ),
    "eye inside a crest": (
        Mutation(
            "lib/rays.glsl",
            (("max(tau - clamp(gap / rate, -limit, limit), least)", "tau - clamp(gap / rate, -limit, limit)"),),
            test=_function("no step behind the eye"),
        ),
    ),
    "eye far below the water": (
        Mutation(
            "surface/march.glsl",
            (("max(u_eye_height - u_surface_trough, 0.0)", "(u_eye_height - u_surface_trough)"),),
            test=_function("a march from far below"),
        ),
    ),
    "groups, thirty years later and ten thousand kilometres away": (_TIME, _PLACE),
}

_SEA = {
    "a sea without wind": (
        Mutation("effects/waves/sea.py", ((" or scene.sea.wind_speed <= 0.0", ""),), error="ZeroDivisionError"),
        Mutation(
            "ocean/waves/cascades.py",
            (("if sea.wind_speed <= 0.0:", "if sea.wind_speed < 0.0:"), ("sea.wind_speed > 0.0 and", "")),
            error="ZeroDivisionError",
        ),
        Mutation("ocean/basics/spectrum.py", (("if wind <= 0.0:", "if wind < 0.0:"),), error="ZeroDivisionError"),
    ),
    "the open sea at any time": (
        Mutation(_RULES, (("(_modulo(state.time + rule.offset, rule.period),)", "(state.time + rule.offset,)"),)),
    ),
    "the open sea ten thousand kilometres away": (_PLACE,),
    "a hurricane that has blown over a hundred metres": (
        Mutation(
            "ocean/waves/cascades.py", (("requested if requested * slope <= TILT else TILT / slope", "requested"),)
        ),
    ),
    "a breath of wind, and no wave on the largest tile": (
        Mutation(
            "waves/sea_passes.glsl",
            (
                (
                    "slope *= min(1.0, u_sea_limit.y / max(length(slope), 1e-30))",
                    "slope = min(length(slope), u_sea_limit.y) * normalize(slope)",
                ),
            ),
        ),
    ),
}

_RINGS = {
    "a hundred rings at one point": (
        Mutation(
            "ocean/waves/rings.py",
            (
                ("total += w * train", "total = w * train"),
                ("min(_over_the_plane(shown), _over_time(shown))", "_over_the_plane(shown)"),
            ),
        ),
    ),
    "a ring at its own centre at its birth": (
        Mutation(
            "waves/rings.glsl", (("float soft = RING_SOFT * wavelength", "float soft = 0.0"), (" || rho >= front", ""))
        ),
    ),
    "a front without width": (
        Mutation("waves/rings.glsl", (("float band = 1.0 / (RING_FRONT * wavelength)", "float band = 1e6"),)),
    ),
    "rings a thousand million seconds from now": (_TIME,),
    "rings ten thousand kilometres away": (_PLACE,),
    "rings long dead": (
        Mutation(
            "waves/rings.glsl",
            (("amplitude <= 0.0 || rho", "rho"),),
            test="tests/gpu/reference/waves/test_rings.py::test_a_dead_ring_leaves_no_trace",
        ),
    ),
}

_WAKES = {
    "the edge of a wake, where both systems meet": (_WAKE_EDGE,),
    "the centre of a boat's circle, and straight behind it": (
        Mutation(
            "boats/wake.glsl",
            (
                ("max(length(from), 0.1 * radius)", "length(from)"),
                ("max(q, 1e-4)", "q"),
                ("max(q * q, 1e-8)", "(q * q)"),
            ),
            test=f"{_GUARDS}::test_wakes_at_the_centre_and_on_the_course",
        ),
    ),
    "a wake from thirty years ago": (_TIME,),
}

_RIPPLES = {
    "ripples at any time": (_TIME,),
    "ripples ten thousand kilometres away": (_PLACE,),
    "gusts anywhere, at any time": (_TIME, _PLACE),
    "the steepest ripples, all one way": (
        Mutation(
            "light/shade.glsl",
            (("float cv = sqrt(nv * nv + sigma2 * aside2)", "float cv = nv"),),
            test=f"{_GUARDS}::test_no_facet_that_faces_away_glitters",
        ),
    ),
}

_NO_SQUARE = ("a = max(a, 1e-7);", "")

_BOATS = {
    "a boat on a breaking crest": (Mutation("boats/pose.glsl", (("slope /= max(length(slope), 1.0);", ""),)),),
    "a boat on dry land": (
        Mutation("boats/pose.glsl", (("max(waves(p).x, shore_floor(shore_place(p)).x + draught)", "waves(p).x"),)),
    ),
    "a boat ten thousand kilometres away, after thirty years": (_TIME, _PLACE),
    "eye in a boat": (
        Mutation(
            "boats/hull.glsl",
            (("max(enter.w, least)", "enter.w"), ("leave > least", "true"), (") > least", ") > -1e9")),
        ),
    ),
    "rays along a boat's own axes": (
        Mutation("boats/hull.glsl", (_NO_SQUARE, ("abs(rate) < 1e-9", "false")), test=_function("rays abeam")),
    ),
}

_SPRAY = {
    "spray under the camera": (
        Mutation("spray/drawn.glsl", ((" * smoothstep(0.3, 1.0, depth) * (1.0 - around)", ""),)),
    ),
    "spray of waves ten thousand kilometres away, after thirty years": (_TIME, _PLACE),
    "spray of a storm ten thousand kilometres away, after ten days": (_TIME, _PLACE),
    "spray on rocks ten thousand kilometres away, after thirty years": (_TIME, _PLACE),
    "spray from crests and troughs, where waves have no slope": (
        Mutation("spray/births.glsl", (("max(dot(fronts.yz, fronts.yz), 0.02)", "dot(fronts.yz, fronts.yz)"),)),
    ),
    "drops of a thousandth of a sample": (
        Mutation("spray/drawn.glsl", (("max(size, 0.75)", "size"),), test=f"{_GUARDS}::test_drops_are_the_references"),
    ),
    "spray before the brightest sun, ten stops up": (
        Mutation(
            "spray/drawn.glsl",
            (("SPRAY_BRIGHTEST = 64.0", "SPRAY_BRIGHTEST = 1e30"),),
            test=f"{_GUARDS}::test_sums_of_drops_stay_below_the_greatest_half_float",
        ),
    ),
    "spray of surf on a beach ten thousand kilometres away, after thirty years": (_TIME, _PLACE),
    "a burst upon a burst, and a sea that throws drops beside them": (
        Mutation("spray/air.glsl", (("sum.a < 1e-4", "false"),)),
    ),
}

_OTHERS = {
    "shadow of a boat under a low sun over a floor": (
        Mutation("boats/hull.glsl", (_NO_SQUARE,), test=_function("rays abeam")),
    ),
    "a current for thirty years": (_TIME,),
    "the edge of standing waves, and straight behind a stone": (_WAKE_EDGE,),
    "as many touches as there may be, at one place": (
        Mutation(
            "waves/rings.glsl",
            (
                (
                    "vec3 touches_detail(vec2 p, Footprint fp) {",
                    "vec3 touched(vec2 p, Footprint fp, bool high);\nvec3 touches_waves(vec2 p) {\n"
                    "    return touched(p, Footprint(vec2(0.0), vec2(0.0)), true);\n}\n"
                    "vec4 touches_shading(vec2 p, Footprint fp) {\n"
                    "    return vec4(touched(p, fp, true).x, touched(p, fp, false));\n}\n"
                    "vec3 touched(vec2 p, Footprint fp, bool high) {",
                ),
                ("sum += vec3(kept", "sum += high ? vec3(ring.x, ring.y * ring.z * way) : vec3(kept"),
            ),
            test=f"{_GUARDS}::test_no_ray_misses_a_ring_of_touches",
        ),
        Mutation(
            "effects/waves/touch.py",
            (
                ('SlotFile("detail"', 'SlotFile("waves"'),
                ("bound=_bound(scene)", "bound=_bound(scene), max_height=0.004, min_height=-0.004, max_slope=1.0"),
            ),
            test=f"{_GUARDS}::test_no_ray_misses_a_ring_of_touches",
        ),
    ),
    "touches a thousand million seconds from now": (_TIME,),
    "touches ten thousand kilometres away": (_PLACE,),
    "touches long over, and touches of no strength": (
        Mutation("waves/rings.glsl", (("amplitude <= 0.0 || rho", "rho"), ("touch.w <= 0.0 || !ring", "!ring"))),
    ),
    "touches of a river thirty years after its current set in": (_TIME,),
}

MUTATIONS = _PARAMETRIC | _SEA | _RINGS | _WAKES | _RIPPLES | _BOATS | _SPRAY | _OTHERS

UNSEEN = {
    "ripples a million to a pixel": "not needed: exp of a large negative number is 0, as is what is left of a ripple",
    "white water at a stone's middle, and far down the current": "not needed: exp of a large negative number is 0, and "
    "so is the foam there",
}
"""Cases by name, and why no picture and no function's value can show here what their guard does."""
