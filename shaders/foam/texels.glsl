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

// Levels are numbers here: drivers that read one level for four pixels at a time take that of pixels which lie elsewhere.
#define LEVEL(i) max(1.0 - abs(wanted - float(i)), 0.0) * bilinear(from, uv, i)
vec4 trilinear(sampler2D from, vec2 uv, float level) {
    float wanted = min(level, 8.0);
    return LEVEL(0) + LEVEL(1) + LEVEL(2) + LEVEL(3) + LEVEL(4) + LEVEL(5) + LEVEL(6) + LEVEL(7) + LEVEL(8);
}
