"""GLSL of slots that no effect fills."""

from seafoam.effects.shader import Inline, constant_function

BLACK_SKY = Inline(
    "\n".join(
        constant_function("vec3", name, f"vec3 {argument}").text
        for name, argument in (("sky_light", "d"), ("horizon_light", "d"), ("mirrored_sky", "r, vec3 spread"))
    )
    + "\nfloat exposure() {\n    return 1.0;\n}\n"
)
NO_ALBEDO = constant_function("float", "foam_albedo", "")
NO_APPROACH = Inline(
    "void march_open(vec3 ray, float leave, float fine, vec3 now, vec2 less, float bend, inout float tau) {\n}\n"
)
NO_BEYOND = constant_function("vec3", "surface_beyond", "vec3 ray, float aside", "vec3(1e30, 0.0, 0.0)")
NO_BOAT_SHADOW = constant_function("float", "sunlit", "vec3 place, Footprint fp", "open_sun(place, fp)")
NO_BUBBLES = Inline(
    "vec3 aerated(vec3 body, vec3 deep, vec3 below, vec3 extinction, float cv, float f) {\n    return body;\n}\n"
)
NO_CLOUDS = Inline(
    "vec4 clouds_along_horizon() {\n    return vec4(0.0);\n}\n\n"
    "vec4 clouds(vec3 d, vec2 spread, out float hidden) {\n    hidden = 0.0;\n    return vec4(0.0);\n}\n"
)
NO_CIRRUS = Inline(
    "vec4 cirrus(vec3 d, vec2 spread, out float hidden) {\n    hidden = 0.0;\n    return vec4(0.0);\n}\n"
)
NO_CREST_LIGHT = constant_function("vec3", "crest_light", "vec3 d, vec3 absorption, float height")
NO_FLOOR = Inline(
    "void look_through(vec2 p, float height, vec3 d, vec3 normal, float unresolved, Footprint fp) {\n}\n",
)
NO_FLOOR_BELOW = constant_function("float", "bed_reach", "vec2 p, float y, vec3 d", "1e6")
NO_FLOOR_LIGHT = constant_function("vec3", "bed_light", "vec2 at, float down, Footprint fp")
NO_FOAM = constant_function("float", "foam_amount", "float f, vec2 p, Footprint fp")
NO_FOAM_ON_LAND = constant_function("float", "land_foam", "vec2 p, float ground, Footprint fp")
NO_GLARE = Inline("vec3 with_glare(vec3 light) {\n    return light;\n}\n")
NO_GLITTER = constant_function("vec3", "glitter_light", "vec3 d, vec3 n, float sigma2, float cv")
NO_LAND = Inline(
    "bool find_land_ahead(vec3 ray, out float land_tau, out vec4 ground) {\n"
    "    land_tau = 0.0;\n    ground = vec4(0.0);\n    return false;\n}\n\n"
    "vec4 land_color(vec3 ray, vec3 d, float tau, vec4 ground) {\n    return vec4(0.0);\n}\n"
)
NO_MOON = Inline(
    constant_function("vec3", "moon_glow", "vec3 d").text
    + "\n"
    + constant_function("vec3", "moon_glow_rim", "vec2 level, vec3 d").text
)
NO_MOON_DISC = constant_function("vec4", "moon_disc", "vec3 d")
NO_RAIN = Inline("vec3 in_rain(vec3 light, vec3 d, vec2 spread, inout float hidden) {\n    return light;\n}\n")
NO_RELIEF = Inline("void foam_relief(float f, float amount, vec2 p, Footprint fp) {\n}\n")
MATT_FOAM = Inline("vec4 foam_layer(vec3 n, vec3 d, float f) {\n    return vec4(foam_light(n), 1.0);\n}\n")
NO_SHORT_BOUNDS = constant_function("vec3", "short_bounds", "")
NO_SHORT_WAVES = Inline("const bool SHORT_WAVES = false;\n\nvec3 short_waves() {\n    return vec3(0.0);\n}\n")
NO_STARS = constant_function("vec3", "star_light", "vec3 d, float pixel")
NO_SUN_DISC = constant_function("vec3", "sun_disc", "vec3 d")
