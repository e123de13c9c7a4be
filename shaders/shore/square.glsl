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
