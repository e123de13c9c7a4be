// Ripples read from the two tiles that the frame drew: exact at the texels, bilinear between them. A tile alone shows as a lattice, so
// each is read once more, turned. docs/formulae.md, section 2.
uniform sampler2D u_ripples_0;
uniform sampler2D u_ripples_1;
uniform vec2 u_ripples_offset[2 * RIPPLE_COPIES]; // the eye's place in each tile and in its copy, in tiles
uniform float u_ripples_size[2];                  // m

const mat2 RIPPLES_TURN = mat2(20.0, 21.0, -21.0, 20.0) / 29.0;

vec2 ripples_copy(int i, vec2 p, vec4 kept) {
    vec4 long_tile = textureLod(u_ripples_0, p / u_ripples_size[0] + u_ripples_offset[i], 0.0);
    vec4 short_tile = textureLod(u_ripples_1, p / u_ripples_size[1] + u_ripples_offset[i + 1], 0.0);
    return kept.x * long_tile.xy + kept.y * long_tile.zw + kept.z * short_tile.xy + kept.w * short_tile.zw;
}

// Gradient, and the unresolved mean square slope.
vec3 ripples_detail(vec2 p, Footprint fp) {
    vec4 kept = vec4(ripples_kept(0, fp), ripples_kept(1, fp), ripples_kept(2, fp), ripples_kept(3, fp));
    vec2 slope = ripples_copy(0, p, kept);
    if (RIPPLE_COPIES > 1) {
        slope += RIPPLES_TURN * ripples_copy(2 * (RIPPLE_COPIES - 1), p * RIPPLES_TURN, kept);
    }
    return vec3(slope, ripples_lost(kept));
}
