// Bilinear reads in float32: samplers weigh texels in 256 steps, and not every device filters float textures.

// a, b: of one row; c, d: of the next; t: in [0, 1], along the rows and across.
vec4 bilinear(vec4 a, vec4 b, vec4 c, vec4 d, vec2 t) {
    return mix(mix(a, b, t.x), mix(c, d, t.x), t.y);
}

// Between the columns and rows of two texels, wherever these are. Row by row: four texels at once would take more registers.
vec4 bilinear_between(sampler2D map, ivec2 first, ivec2 next, vec2 t) {
    vec4 row = mix(texel_at(map, first), texel_at(map, ivec2(next.x, first.y)), t.x);
    return mix(row, mix(texel_at(map, ivec2(first.x, next.y)), texel_at(map, next), t.x), t.y);
}

// From a periodic block of a map. corner: its first texel; size: its side, a power of 2; at: place in it, texel j is at j.
vec4 bilinear_wrapped(sampler2D map, ivec2 corner, int size, vec2 at) {
    vec2 base = floor(at);
    ivec2 first = ivec2(base) & (size - 1);
    return bilinear_between(map, corner + first, corner + ((first + 1) & (size - 1)), at - base);
}

// From a square map, held at its rim. at: place in it, texel j is at j.
vec4 bilinear_held(sampler2D map, int size, vec2 at) {
    at = clamp(at, 0.0, float(size - 1));
    ivec2 first = min(ivec2(at), size - 2);
    return bilinear_between(map, first, first + 1, at - vec2(first));
}
