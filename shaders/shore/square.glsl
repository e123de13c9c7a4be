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
