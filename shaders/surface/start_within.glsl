// What a pass over wider tiles has found, of those that this tile touches.
uniform sampler2D u_start_wide;

vec2 known_free() {
    ivec2 last = textureSize(u_start_wide, 0) - 1;
    vec2 wide = vec2(last + 1) / u_viewport;
    ivec2 low = clamp(ivec2((gl_FragCoord.xy - 0.501) * wide), ivec2(0), last);
    ivec2 high = clamp(ivec2((gl_FragCoord.xy + 0.501) * wide), ivec2(0), last);
    vec4 a = texel_at(u_start_wide, low);
    vec4 b = texel_at(u_start_wide, ivec2(high.x, low.y));
    vec4 c = texel_at(u_start_wide, ivec2(low.x, high.y));
    vec4 d = texel_at(u_start_wide, high);
    return vec2(min(min(a.r + a.g, b.r + b.g), min(c.r + c.g, d.r + d.g)), min(min(a.b, b.b), min(c.b, d.b)));
}
