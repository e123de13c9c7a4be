"""Of foam: saturations, looks, drift, life, relief, scattering, bubbles."""

from dataclasses import replace

from support.hard.mutations import IN_FLOAT32, Mutation

_FUNCTIONS = "tests/gpu/reference/foam/test_shader_functions.py"
_REFERENCE = "tests/gpu/reference/foam/"
_NUMERICS = "tests/gpu/numerics/"
_GUARDS = f"{_NUMERICS}test_guards_foam.py"
_GUARDED = f"{_GUARDS}::test_functions_are_guarded"
_IN_SHORE = (("max(length(out_to_sea), 1e-6)", "length(out_to_sea)"),)

MUTATIONS = {
    "the pole of every crest, C 0.25": (
        Mutation(
            "foam/saturation/front.glsl",
            (
                ("signal.y == 0.0 ? 80.0 :", ""),
                ("clamp((rho + signal.x) / signal.y, -80.0, 80.0)", "(rho + signal.x) / signal.y"),
            ),
            test=f"{_NUMERICS}test_hard_cases.py::test_front_at_its_pole_and_beyond_the_schemas_c[0.25]",
        ),
    ),
    "the pole of the listing, C 100": (
        Mutation(
            "foam/saturation/front.glsl",
            (
                (
                    "exp(u_front_log_base * exponent)",
                    "exp(-u_front_log_base * tan(0.5 * atan(signal.y, signal.x) + 0.5 * PI))",
                ),
            ),
            test=f"{_NUMERICS}test_hard_cases.py::test_front_at_its_pole_and_beyond_the_schemas_c[0.25]",
        ),
    ),
    "no phase at all: waves in antiphase": (
        Mutation(
            "foam/saturation/front.glsl",
            (("rho > 0.0 ? signal.y / (rho - signal.x) : 0.0", "signal.y / (rho - signal.x)"),),
            test=f"{_GUARDED}[a front of no phase]",
        ),
    ),
    "filtered, where the phase turns endlessly fast": (
        Mutation(
            "foam/saturation/front.glsl",
            (
                ("max(dot(signal, signal), 1e-4)", "dot(signal, signal)"),
                ("clamp(width, 1e-5, 1e4)", "max(width, 1e-5)"),
            ),
            test=f"{_GUARDED}[a front whose phase turns endlessly fast]",
        ),
    ),
    "patches anywhere, at any time": IN_FLOAT32,
    "a gate without width": (
        Mutation(
            "effects/foam/front.py",
            (("max(front.group[1], front.group[0] + 1e-4)", "front.group[1]"),),
            test=f"{_GUARDS}::test_groups_foam_over_a_range",
        ),
    ),
    "footprints from a hair to the horizon": (
        Mutation(
            "foam/saturation/front.glsl",
            (("if (i == j && !crosses)", "if (false)"),),
            test=f"{_GUARDED}[a front under a hair]",
        ),
    ),
    "waves that hide their backs, an eye as high as their crests": (
        Mutation(
            "foam/saturation/front.glsl",
            (
                ("max(relief * length(p), 1e-20)", "(relief * length(p))"),
                ("1.0 - q16, 1e-6), 1e-5)", "1.0 - q16, 1e-6), 0.0)"),
            ),
            test=f"{_GUARDED}[a front as high as the eye]",
        ),
    ),
    "foam over a millimetre, a hundred metres up": (
        Mutation(
            "foam/saturation/height.glsl",
            (("max(u_height_full - u_height_base, 1e-3), 0.0", "(u_height_full - u_height_base), 0.0"),),
            test=f"{_GUARDED}[foam over no height at all]",
        ),
    ),
    "heights that the eye sees, from between the crests and along them": (
        Mutation(
            "foam/saturation/height.glsl",
            (
                (
                    "over > 0.0 ? min(over / (way * along) * u_height_wave.w, 1.0) : 1.0",
                    "min(over / (way * along) * u_height_wave.w, 1.0)",
                ),
            ),
            test=f"{_FUNCTIONS}::test_seen_height_equals_its_float64_form[0.7]",
        ),
    ),
    "foam on walls": (
        Mutation(
            "foam/saturation/slope.glsl",
            (("u_slope_base), 0.0, SLOPE_MOST)", "u_slope_base), -1e30, 1e30)"),),
            test=f"{_REFERENCE}test_slope_and_cells.py::test_slope_saturation_equals_its_float64_form[4.0-0.0]",
        ),
    ),
    "foam on the steepest of many rings": (
        Mutation(
            "foam/saturation/slope.glsl",
            (("dot(wave.yz, wave.yz) + wave.w", "dot(wave.yz, wave.yz)"),),
            test=f"{_GUARDED}[a slope that the footprint filters out]",
        ),
    ),
    "foam of an hour's gale, from near to the horizon": (
        Mutation("foam/saturation/whitecap.glsl", (("if (deviation < 0.02 * limits.y)", "if (false)"),)),
    ),
    "more foam than there is sea": (
        Mutation(
            "foam/saturation/whitecap.glsl",
            (
                (
                    "u_whitecap_variance.z, 1.0)), 1.0)",
                    "u_whitecap_variance.z, 1.0)), 1e30)",
                ),
            ),
            test=f"{_GUARDED}[whitecaps of nine times]",
        ),
    ),
    "a sea too flat to fold": (
        Mutation(
            "ocean/foam/whitecaps.py",
            (("min(now, earlier) < 1e-8 or ", ""),),
            test=f"{_GUARDS}::test_a_sea_that_is_too_flat_has_no_whitecaps",
        ),
    ),
    "filtered, a hair above nothing": (
        Mutation(
            "foam/look.glsl",
            (("covered *= smoothstep(0.0, 1.0 / 256.0, s);", ""),),
            test=f"{_REFERENCE}test_foam_functions.py::test_filtered_coverage_equals_its_float64_form[0.0-vac-1.5]",
        ),
    ),
    "filtered, a hair below all": (
        Mutation(
            "foam/look.glsl",
            (("1.0 - (1.0 - covered) * smoothstep(0.0, 1.0 / 256.0, 1.0 - s)", "covered"),),
            test=f"{_GUARDS}::test_foam_closes_before_its_saturation_is_whole",
        ),
    ),
    "thresholds next to 0 and to 1": (
        Mutation(
            "foam/mask.glsl", (("+ 0.5) / 65536.0", ") / 65536.0"),), test=f"{_GUARDED}[the lowest threshold of a mask]"
        ),
    ),
    "a mask at a thousandth of a texel a pixel": (
        Mutation(
            "foam/look.glsl",
            (
                (
                    "/ 131072.0, 5e-4)",
                    "/ 131072.0, 0.0)",
                ),
            ),
            test=f"{_GUARDED}[a mask that does not change under a footprint]",
        ),
    ),
    "a mask at a thousand texels a pixel": (
        Mutation(
            "foam/look.glsl",
            (("clamp(most, 1.0, float(1 << (MASK_LEVELS - 1)))", "max(most, 1.0)"),),
            test=f"{_GUARDED}[eight tiles of a mask under a footprint]",
        ),
    ),
    "needles: footprints of a tenth of a texel by a thousand": (
        Mutation(
            "foam/look.glsl",
            (
                ("int level = max(form, 0);", "int level = form;"),
                ("<< 23), 1e-2, 0.75 * float(FOAM_SIDE))", "<< 23), 0.0, 0.75 * float(FOAM_SIDE))"),
            ),
            test=f"{_GUARDED}[a footprint without width]",
        ),
    ),
    "a fade too small for float32": (
        Mutation("foam/look.glsl", (("max(2.0 * fade, 1e-30)", "(2.0 * fade)"), ("max(part, 1e-30)", "part"))),
    ),
    "four octaves, ten thousand kilometres away": (
        Mutation(
            "foam/look.glsl",
            (("octave(fract(uv))", "octave(uv)"),),
            test=f"{_GUARDS}::test_octaves_are_alike_in_every_tile",
        ),
    ),
    "a mask turned in each cell, ten thousand kilometres away": tuple(
        replace(
            one,
            test=f"{_REFERENCE}test_slope_and_cells.py::test_frames_with_cells_and_two_textures_equal_float64[filtered]",
        )
        for one in IN_FLOAT32
    ),
    "a mask turned in each cell, a hair below all": (
        Mutation(
            "foam/shading.glsl",
            (("vec2(max(left, 1.0 / 256.0), smoothstep(0.0, 1.0 / 256.0, left))", "vec2(left, 1.0)"),),
            test=f"{_GUARDED}[covers next to whole]",
        ),
    ),
    "a mask turned in each cell, its thresholds hard": (
        Mutation(
            "foam/cells.glsl",
            (
                (
                    "cell_enter(corner[near], way[near]);",
                    "float sum = 0.0;\n    for (int i = 0; i < 3; ++i) {\n        cell_enter(corner[i], way[i]);\n"
                    "        sum += share[i] * cell_amount(f, p, fp);\n    }",
                ),
                ("return cell_amount(f, p, fp);", "return sum;"),
            ),
        ),
    ),
    "black foam over the brightest glitter": (Mutation("foam/look.glsl", (("share = clamp(share, 0.0, 1.0);", ""),)),),
    "foam that has drifted for thirty years": IN_FLOAT32,
    "foam of any age, ten thousand kilometres away": IN_FLOAT32,
    "foam next to none and next to whole, of all ages": (
        Mutation(
            "foam/living.glsl",
            (("uint(WINDROW_SEED))), -1.0)", "uint(WINDROW_SEED))), -1e30)"),),
        ),
    ),
    "foam on a coast without surf": (Mutation("shore/waves.glsl", _IN_SHORE),),
    "surf foam on water as level as its ground": (
        Mutation(
            "foam/saturation/surf.glsl",
            ((", 1e-3, 0.15)", ", 0.0, 0.15)"),),
            test=f"{_GUARDED}[surf on level ground under level water]",
        ),
    ),
    "foam where no way leads to the shore": (
        Mutation("shore/waves.glsl", _IN_SHORE, test=f"{_GUARDED}[surf that no way leads from]"),
    ),
    "the centre of a vortex in the middle of a pixel": (
        Mutation(
            "foam/drift.glsl",
            (("y < 0.05 ?", "y < 0.0 ?"),),
            test=f"{_REFERENCE}test_drift.py::test_flow_equals_float64_right_into_the_centre",
        ),
    ),
    "a hundred texels a step": (
        Mutation(
            "effects/foam/drift.py",
            (
                ('self.forward = quality.drift == "forward"', 'self.forward = quality.drift != "exact"'),
                ('look != "filtered" or quality.drift == "forward"', 'look != "filtered" or quality.drift != "exact"'),
            ),
            test=f"{_REFERENCE}test_drift.py::test_backward_is_one_everywhere_where_forward_gaps_and_piles",
        ),
    ),
    "a vortex that turns twice a second": (
        Mutation(
            "effects/foam/drift.py",
            (
                (
                    "min(quality.drift_step, STEP_TURN * min(quality.drift_step, 1.0) / max(fastest, 1e-6))",
                    "quality.drift_step",
                ),
            ),
        ),
    ),
    "a vortex that has ground its foam finer than texels": (
        Mutation(
            "foam/drift_passes.glsl",
            (("mix(sum, u_drift_coverage, smoothstep(0.5, 2.0, reach))", "sum"),),
            test=f"{_GUARDS}::test_foam_that_is_ground_fine_does_not_flicker",
        ),
    ),
    "drifting foam a thousand million seconds from now": IN_FLOAT32,
    "drifting foam ten thousand kilometres away": (
        Mutation(
            "effects/foam/drift.py",
            (
                (
                    'array("vec2", to_camera(*scene.drift.place), 1),',
                    'array("vec2", to_camera(0.0, 0.0), 1),\n'
                    '            "u_drift_middle": vector((-scene.drift.place[0], -scene.drift.place[1])),',
                ),
            ),
        ),
        Mutation(
            "foam/saturation/drift.glsl",
            (
                ("uniform vec2 u_drift_place;", "uniform vec2 u_drift_middle;\nuniform vec2 u_drift_place;"),
                ("p + u_drift_place;", "(p + u_drift_place) + u_drift_middle;"),
            ),
        ),
        Mutation("foam/drift.glsl", (("p + u_drift_place;", "(p + u_drift_place) + u_drift_middle;"),)),
    ),
    "more drifting foam than the water holds, times foam by height": (
        Mutation(
            "effects/foam/drift.py",
            (('"DRIFT_CAP": 1.0 if foam.look == "filtered" else SATURATION_CAP', '"DRIFT_CAP": SATURATION_CAP'),),
        ),
    ),
    "no current and no vortex": (
        Mutation(
            "effects/foam/drift.py",
            (("drift.vortices or (Vortex(place=drift.place, speed=0.0),)", "drift.vortices"),),
            error="greater than or equal to 1",
        ),
    ),
    "foam under a low sun": (Mutation("foam/shading.glsl", (("max(u_sun_direction.y, 0.25)", "u_sun_direction.y"),)),),
    "foam under a sun overhead": (
        Mutation("foam/shading.glsl", (("1.0 - smoothstep(0.25, 1.0, max(x, y) / max(length(way), 1e-6))", "1.0"),)),
    ),
    "foam with the eye all but on it": (
        Mutation(
            "foam/shading.glsl",
            (("max(x, 1e-6)", "x"), ("max(y, 1e-6)", "y")),
            test=f"{_GUARDED}[a footprint that its shade widens]",
        ),
    ),
    "flat foam seen along its surface against the sun": (
        Mutation(
            "foam/shading.glsl",
            (("u_foam_lumps)), 1e-3)", "u_foam_lumps)), 0.0)"),),
            test=f"{_GUARDED}[smooth foam that neither sun nor eye sees]",
        ),
    ),
    "foam at the centre of a boat's circle": (
        Mutation(
            "boats/wake.glsl",
            (("max(length(from), 0.1 * radius)", "length(from)"),),
            test=f"{_GUARDED}[the centre of a boat's circle]",
        ),
    ),
    "white water along a heeled hull, from its keel line to far abeam": (
        Mutation("foam/saturation/wake.glsl", (("if (past > away)", "if (false)"),)),
    ),
}

UNSEEN = {
    "four octaves, a hair below all": "not needed: the steps of 1/256 at both ends keep 0 and 1 as they are in any "
    "further octave; the guard only saves the work",
    "a foam texture far under a texel": "llvmpipe's logarithm of 0, which GLSL leaves undefined, is -infinity, and the "
    "level is held at 0",
    "milk in water as dark and as clear as it gets": "not needed: bubbles scatter back at least what the water of "
    "their layer does: deep (1 - passed) more; by rounding none of 2 million random waters was negative",
}
"""Cases whose guards no picture and no function's value can show, and why."""
