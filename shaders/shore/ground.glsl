// The ground's height, and the map of it.

// @part square
// The square of the shore: places in it are metres from its middle. docs/formulae.md, section 8.
uniform float u_shore_size; // its side, m

// In texels, texel centres at whole numbers; outside the square the nearest place on its edge.
vec2 shore_texel(vec2 q, float texels) {
    return clamp(q / u_shore_size + 0.5, 0.0, 1.0) * texels - 0.5;
}

// 1 inside the square, 0 outside, where nothing changes any more.
vec2 shore_inside(vec2 q) {
    return step(abs(q), vec2(0.5 * u_shore_size));
}

// Where a ray over q, metres from the middle, is in the square: from x to y, in units of its way; nowhere, where y is not more than x.
vec2 shore_span(vec2 q, vec2 way) {
    vec2 level = vec2(abs(way.x) < 1e-9 ? 1e-9 : way.x, abs(way.y) < 1e-9 ? 1e-9 : way.y);
    vec2 one = (-0.5 * u_shore_size - q) / level;
    vec2 two = (0.5 * u_shore_size - q) / level;
    return vec2(max(max(min(one.x, two.x), min(one.y, two.y)), 0.0), min(max(one.x, two.x), max(one.y, two.y)));
}

// How far along a way from q, metres from the middle, the square is left for good, also by ways up to `aside` a unit beside it.
float shore_leaves(vec2 q, vec2 way, float aside) {
    vec2 left = max(0.5 * u_shore_size - sign(way) * q, 0.0);
    vec2 outward = abs(way) - aside;
    vec2 leaves = mix(vec2(1e30), left / max(outward, 1e-9), greaterThan(outward, vec2(1e-9)));
    return min(leaves.x, leaves.y);
}

// @part place
// Where the square of the shore lies: metres from its middle. docs/formulae.md, section 8.
uniform float u_shore_place[2]; // the eye from the square's middle, as a phase: pi is half of SHORE_PERIOD metres

vec2 shore_place(vec2 p) {
    return p + vec2(u_shore_place[0], u_shore_place[1]) * (SHORE_PERIOD / TAU);
}

// @part ground
// Land and sea floor: how high and steep they are at most, and what colour.
uniform float u_shore_top;       // nothing is higher, m
uniform float u_shore_steepest[2]; // slope of the floor, and of what stands over y = 0
uniform float u_shore_bend;      // second derivative of the floor in the square where it turns up, 1/m
uniform float u_shore_swash;     // height that waves reach on the beach, m
uniform float u_shore_plants_from;
uniform float u_shore_reef;
uniform vec3 u_shore_sand;
uniform vec3 u_shore_rock;
uniform vec3 u_shore_plants;

// Grain of what lies there: octaves of noise that fade out before they are smaller than the footprint.
float shore_grain(vec2 q, Footprint fp) {
    float reach = sqrt(max(dot(fp.x, fp.x), dot(fp.y, fp.y)));
    float sum = 0.5;
    float cell = 9.0;
    for (int i = 0; i < 5; ++i) {
        // Each octave is turned against the last (3-4-5), so that no lattice shows.
        q = vec2(0.8 * q.x - 0.6 * q.y, 0.6 * q.x + 0.8 * q.y);
        sum += (noise_value(NOISE_KEY, q / cell) - 0.5) * 0.45 * (1.0 - smoothstep(0.15 * cell, 0.6 * cell, reach));
        cell *= 0.31;
    }
    return clamp(sum, 0.0, 1.0);
}

float shore_wet(float y) {
    return 1.0 - smoothstep(0.5 * u_shore_swash, 1.1 * u_shore_swash + 0.05, y);
}

// Reflectance of the ground: sand, dark where wet; rock where steep; plants higher up; reef and weed under water.
vec3 ground_albedo(vec4 ground, float grain) {
    float steep = length(ground.yz);
    float rocky = smoothstep(0.35, 0.6, steep + 0.25 * (grain - 0.5));
    float grown = smoothstep(u_shore_plants_from, 1.25 * u_shore_plants_from + 0.5, ground.x + 4.0 * (ground.w - 0.5) + 1.5 * (grain - 0.5));
    float reef = u_shore_reef * smoothstep(0.52, 0.6, ground.w + 0.12 * (grain - 0.5)) * smoothstep(0.4, 2.0, -ground.x);
    vec3 albedo = u_shore_sand * (0.8 + 0.4 * grain);
    albedo = mix(albedo, vec3(0.08, 0.085, 0.05) * (0.5 + grain), reef);
    albedo = mix(albedo, u_shore_plants * (0.4 + 1.2 * grain), grown);
    albedo = mix(albedo, u_shore_rock * (0.5 + grain), rocky);
    return albedo * mix(1.0, 0.55, shore_wet(ground.x));
}

// @part bed
// The shore's floor as an eye under water sees it.
vec3 bed_albedo(vec2 at, Footprint fp) {
    vec2 q = shore_place(at);
    return ground_albedo(shore_floor(q), shore_grain(q, fp));
}

// @part spline
// The uniform quadratic B-spline through a map of the shore's square: smooth slopes, and never past the texels.
// Weights of three texels, t in [0, 1) from the first half-way point on, and their derivatives.
vec3 bspline_weights(float t) {
    float u = 1.0 - t;
    return vec3(0.5 * u * u, 0.5 + t * u, 0.5 * t * t);
}

vec3 bspline_slopes(float t) {
    return vec3(t - 1.0, 1.0 - 2.0 * t, t);
}

// What a place reads: the middle one of nine texels, weights and slopes along x and z, and the change a metre of a unit of slope.
struct SplineTaps {
    ivec2 middle;
    vec3 wx;
    vec3 wz;
    vec3 sx;
    vec3 sz;
    vec2 scale;
};

// q: metres from the middle of the square; size: texels along a side of the map.
SplineTaps spline_taps(vec2 q, int size) {
    vec2 at = shore_texel(q, float(size)) + 0.5;
    vec2 base = floor(at);
    vec2 t = at - base;
    return SplineTaps(
        as_int(base), bspline_weights(t.x), bspline_weights(t.y), bspline_slopes(t.x), bspline_slopes(t.y),
        float(size) / u_shore_size * shore_inside(q));
}

vec4 spline_texel(sampler2D map, int size, SplineTaps taps, int i, int j) {
    return texel_at(map, clamp(taps.middle + ivec2(i - 1, j - 1), ivec2(0), ivec2(size - 1)));
}
