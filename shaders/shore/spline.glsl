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
        ivec2(base), bspline_weights(t.x), bspline_weights(t.y), bspline_slopes(t.x), bspline_slopes(t.y),
        float(size) / u_shore_size * shore_inside(q));
}

vec4 spline_texel(sampler2D map, int size, SplineTaps taps, int i, int j) {
    return texel_at(map, clamp(taps.middle + ivec2(i - 1, j - 1), ivec2(0), ivec2(size - 1)));
}
