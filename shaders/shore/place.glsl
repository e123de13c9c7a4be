// Places in the square of the shore: metres from its middle. docs/formulae.md, section 8.
uniform float u_shore_place[2]; // the eye from the square's middle, as a phase: pi is half of SHORE_PERIOD metres
uniform float u_shore_size;     // side of the square, m

vec2 shore_place(vec2 p) {
    return p + vec2(u_shore_place[0], u_shore_place[1]) * (SHORE_PERIOD / TAU);
}

// In texels, texel centres at whole numbers; outside the square the nearest place on its edge.
vec2 shore_texel(vec2 q, float texels) {
    return clamp(q / u_shore_size + 0.5, 0.0, 1.0) * texels - 0.5;
}

// 1 inside the square, 0 outside, where nothing changes any more.
vec2 shore_inside(vec2 q) {
    return step(abs(q), vec2(0.5 * u_shore_size));
}
