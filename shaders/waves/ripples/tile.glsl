// Ripples read from the two tiles that the frame drew: exact at the texels, bilinear between them.
uniform sampler2D u_ripples_0;
uniform sampler2D u_ripples_1;
uniform vec2 u_ripples_offset[2]; // the eye's place in each tile, in tiles
uniform float u_ripples_size[2];  // m

// Gradient, and the unresolved mean square slope.
vec3 ripples_detail(vec2 p, Footprint fp) {
    vec4 kept = vec4(ripples_kept(0, fp), ripples_kept(1, fp), ripples_kept(2, fp), ripples_kept(3, fp));
    vec4 long_tile = textureLod(u_ripples_0, p / u_ripples_size[0] + u_ripples_offset[0], 0.0);
    vec4 short_tile = textureLod(u_ripples_1, p / u_ripples_size[1] + u_ripples_offset[1], 0.0);
    vec2 slope = kept.x * long_tile.xy + kept.y * long_tile.zw + kept.z * short_tile.xy + kept.w * short_tile.zw;
    return vec3(slope, ripples_lost(kept));
}
