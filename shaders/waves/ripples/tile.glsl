// Ripples read from the two tiles that the frame drew: exact at the texels, bilinear between them.
uniform sampler2D u_chop_0;
uniform sampler2D u_chop_1;
uniform vec2 u_chop_offset[2]; // the eye's place in each tile, in tiles
uniform float u_chop_size[2];  // m

// Gradient, and the unresolved mean square slope.
vec3 chop_detail(vec2 p, Footprint fp) {
    vec4 kept = vec4(chop_kept(0, fp), chop_kept(1, fp), chop_kept(2, fp), chop_kept(3, fp));
    vec4 long_tile = textureLod(u_chop_0, p / u_chop_size[0] + u_chop_offset[0], 0.0);
    vec4 short_tile = textureLod(u_chop_1, p / u_chop_size[1] + u_chop_offset[1], 0.0);
    vec2 slope = kept.x * long_tile.xy + kept.y * long_tile.zw + kept.z * short_tile.xy + kept.w * short_tile.zw;
    return vec3(slope, chop_lost(kept));
}
