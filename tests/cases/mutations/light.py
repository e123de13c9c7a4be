"""Of sky, sun, moon, clouds and their shadows, glitter and sparkles, a level floor, and light in crests."""

from support.hard.mutations import IN_FLOAT32, Mutation

_BRIGHTEST = (
    Mutation("surface/main.glsl", (("min(light, BRIGHTEST)", "light"),)),
    Mutation(
        "light/sky.glsl",
        (("min(exposure() * (sky_light(d) + sun_disc(d)), BRIGHTEST)", "exposure() * (sky_light(d) + sun_disc(d))"),),
    ),
)
_FUNCTIONS = "tests/gpu/numerics/test_guards_light.py"
_NO_OFFSET = "ZeroDivisionError"

MUTATIONS = {
    "sun at the horizon": (
        Mutation("light/sky.glsl", (("(max(d.y, 0.0) + 0.09)", "max(d.y, 0.0)"),), error=_NO_OFFSET),
        Mutation("effects/light/atmosphere.py", (("(max(height, 0.0) + 0.03)", "max(height, 0.0)"),), error=_NO_OFFSET),
    ),
    "sun under the horizon": (
        Mutation("effects/light/atmosphere.py", (("(max(height, 0.0) + 0.03)", "max(height, 0.0)"),), error=_NO_OFFSET),
    ),
    "sun at the zenith": (Mutation("light/sky.glsl", (("(max(d.y, 0.0) + 0.09)", "max(d.y, 0.0)"),)),),
    "straight up and straight down, no heading": (
        Mutation(
            "light/sky.glsl",
            (("max(length(d.xz), 1e-6)) * u_air_horizon", "length(d.xz)) * u_air_horizon"),),
            test=f"{_FUNCTIONS}::test_the_horizon_is_no_heading_straight_down",
        ),
    ),
    "the brightest disc, ten stops up": _BRIGHTEST,
    "ten stops down at night": (
        Mutation(
            "effects/light/atmosphere.py",
            (("NIGHT = 0.002", "NIGHT = 0.0"),),
            test=f"{_FUNCTIONS}::test_no_night_is_black_in_half_floats",
        ),
    ),
    "no lamp at all: the sun down, the moon not yet counted": (
        Mutation("effects/light/atmosphere.py", (("* dark * smooth(", "* smooth("),)),
    ),
    "fog on the eye": (
        Mutation("lib/rays.glsl", (("max(tau - clamp(gap / rate, -limit, limit), least)", "tau - gap / rate"),)),
    ),
    "high clouds anywhere, at any time": IN_FLOAT32,
    "clouds anywhere, at any time": IN_FLOAT32,
    "the layer's way from the horizon to overhead": (
        Mutation(
            "light/clouds.glsl",
            (("rest / (along + sqrt(along * along + rest))", "sqrt(along * along + rest) - along"),),
        ),
    ),
    "eye above the clouds": (
        Mutation(
            "light/clouds.glsl", (("return 1.0 - smoothstep(0.5, 0.9, u_eye_height / u_cloud_shape.x)", "return 1.0"),)
        ),
    ),
    "a hundred thousand little clouds": (
        Mutation(
            "light/clouds.glsl",
            (("float kept = 1.0 - smoothstep(0.15, 0.6, width);\n        if", "float kept = 1.0;\n        if"),),
        ),
    ),
    "shadows of clouds anywhere, at any time": IN_FLOAT32,
    "shadows of clouds out to the horizon": (
        Mutation("light/clouds.glsl", (("sqrt(side2 + u_cloud_sunward.w * u_cloud_sunward.w)", "u_cloud_sunward.w"),)),
    ),
    "eye above the clouds that throw shadows": (
        Mutation(
            "light/clouds.glsl",
            (("float under = 1.0 - smoothstep(0.5, 0.9, u_eye_height / u_cloud_shape.x)", "float under = 1.0"),),
        ),
    ),
    "the moon before the sun": (
        Mutation("light/night.glsl", (("sqrt(max(dot(normal, u_moon_sun), 0.0))", "sqrt(dot(normal, u_moon_sun))"),)),
    ),
    "stars in the widest view": (
        Mutation("light/night.glsl", (("clamp(1.5 * pixel, 7e-4, 3e-3)", "max(1.5 * pixel, 7e-4)"),)),
    ),
    "facets seen edge-on": (
        Mutation(
            "light/glitter.glsl",
            (("max(dot(n, h), 1e-3)", "dot(n, h)"),),
            test=f"{_FUNCTIONS}::test_facets_that_face_away_reflect_no_sun",
        ),
    ),
    "the brightest path of the sun": (
        Mutation(
            "light/glitter.glsl",
            (
                ("return min(u_sun_irradiance *", "return max(u_sun_irradiance *"),
                ("slopes / (4.0 * cv)), 1e4)", "slopes / (4.0 * cv)), 0.0)"),
            ),
        ),
        *_BRIGHTEST,
    ),
    "the lake's highlight at its sharpest": (
        Mutation(
            "light/glitter.glsl", (("clamp(dot(n, h) / max(length(h), 1e-6), 0.0, 1.0)", "dot(n, h) / length(h)"),)
        ),
    ),
    "sparkles at any time": IN_FLOAT32,
    "one sparkle for the whole sun": _BRIGHTEST,
    "sparkles so many that they run together": (
        Mutation(
            "light/glitter.glsl",
            ((" * (1.0 - smoothstep(0.5, 2.0, u_sparkle_density * w * side * side * l1 * l1 * l1))", ""),),
        ),
    ),
    "sparkles of a sun that sets through the horizon": (
        Mutation(
            "light/glitter.glsl",
            (
                ("float w = max((glint.r", "float w = ((glint.r"),
                (
                    "max(u_sun_irradiance.r + u_sun_irradiance.g + u_sun_irradiance.b, 1e-20), 1e-20)",
                    "(u_sun_irradiance.r + u_sun_irradiance.g + u_sun_irradiance.b))",
                ),
            ),
        ),
    ),
    "sparkles smaller than a hundredth of a pixel": (
        Mutation("light/glitter.glsl", (("clamp(least, u_sparkle_radius, 0.25)", "u_sparkle_radius"),)),
    ),
    "no crest at all": (
        Mutation(
            "effects/light/subsurface.py",
            (
                (
                    "number(1.0 / (highest - lowest) if highest - lowest > 1e-37 else 0.0)",
                    "number(1.0 / (highest - lowest))",
                ),
            ),
            error="ZeroDivisionError",
        ),
    ),
    "five centimetres of black water": (
        Mutation(
            "water/body.glsl",
            (("float slant = refracted_cosine(min(cv, 1.0), INDEX)", "float slant = refracted_cosine(cv, INDEX)"),),
            test=f"{_FUNCTIONS}::test_light_at_grazing_incidence_comes_from_the_floor_as_along_the_water",
        ),
    ),
}

UNSEEN = {
    "sparkles straight down, under the sun at the zenith": "no guard but a choice: cells that have no pole",
    "glare of the brightest sun": "not needed: levels are means of a frame that holds at most 65504",
    "sun setting through 0 degrees under a layered sky": "not needed: the sky's glow is a polynomial there",
    "rain all around, looked up to from below": "no sample looks straight up",
    "shadows of clouds under a sun that touches the horizon": "such a sun has next to no light",
    "shadows of clouds that leave next to no light": "not needed: the thickest overcast leaves more",
    "moon and sun opposite": "llvmpipe's max(NaN, 0) is 0",
    "stars at the corner of the cube": "no sample looks along the edge of a face",
    "into the sun on the horizon": "llvmpipe's max(NaN, x) is x",
    "lamp overhead": "not needed: the azimuth of a lamp overhead is a unit vector in float64, whatever its heading",
    "shadows of clouds, of a hill and of a boat on each other": "not needed: no factor is above 1",
    "the clearest water over a white floor": "the schema alone keeps absorption over 0; nothing in the program does",
}
