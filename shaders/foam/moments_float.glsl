// Mean of m and of m^2 over a square of 2^level texels, trilinear, from float32 by hand: exact where samplers are not.
uniform sampler2D u_mask_moments;

vec2 mask_moments_level(vec2 uv, int level) {
    int size = max(MASK_SIZE >> level, 1);
    vec2 at = uv * float(size) - 0.5;
    vec2 base = floor(at);
    vec2 t = at - base;
    ivec2 low = ivec2(base) & (size - 1);
    ivec2 high = (ivec2(base) + 1) & (size - 1);
    vec2 a = texelFetch(u_mask_moments, low, level).rg;
    vec2 b = texelFetch(u_mask_moments, ivec2(high.x, low.y), level).rg;
    vec2 c = texelFetch(u_mask_moments, ivec2(low.x, high.y), level).rg;
    vec2 d = texelFetch(u_mask_moments, high, level).rg;
    return mix(mix(a, b, t.x), mix(c, d, t.x), t.y);
}

vec2 mask_moments(vec2 uv, float level) {
    float held = clamp(level, 0.0, float(MASK_LEVELS - 1));
    int lower = min(int(held), MASK_LEVELS - 1);
    int upper = min(lower + 1, MASK_LEVELS - 1);
    return mix(mask_moments_level(uv, lower), mask_moments_level(uv, upper), held - float(lower));
}
