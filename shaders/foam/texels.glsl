// The foam texture filtered in float32: samplers weigh with some 8 bits.
vec4 bilinear(sampler2D from, vec2 uv, int level) {
    ivec2 size = textureSize(from, level);
    vec2 at = fract(uv) * vec2(size) - 0.5;
    ivec2 low = ivec2(floor(at));
    vec2 part = at - vec2(low);
    // Before the wrap from -1 to the size itself.
    ivec2 high = (low + 1) % size;
    low = (low + size) % size;
    vec4 below = mix(texelFetch(from, low, level), texelFetch(from, ivec2(high.x, low.y), level), part.x);
    vec4 above = mix(texelFetch(from, ivec2(low.x, high.y), level), texelFetch(from, high, level), part.x);
    return mix(below, above, part.y);
}

vec4 part_of(sampler2D from, vec2 uv, float wanted, int level) {
    return max(1.0 - abs(wanted - float(level)), 0.0) * bilinear(from, uv, level);
}

// Levels are numbers here: drivers that read one level for four pixels at a time take that of pixels which lie elsewhere.
vec4 trilinear(sampler2D from, vec2 uv, float level) {
    float wanted = min(level, 8.0);
    vec4 fine = part_of(from, uv, wanted, 0) + part_of(from, uv, wanted, 1) + part_of(from, uv, wanted, 2);
    vec4 middle = part_of(from, uv, wanted, 3) + part_of(from, uv, wanted, 4) + part_of(from, uv, wanted, 5);
    return fine + middle + part_of(from, uv, wanted, 6) + part_of(from, uv, wanted, 7) + part_of(from, uv, wanted, 8);
}
