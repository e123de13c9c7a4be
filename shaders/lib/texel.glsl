// A texel of a texture that is read by its nearest: as texelFetch, which takes llvmpipe up to three times as long.
vec4 texel_at(sampler2D from, ivec2 at) {
    return textureLod(from, (vec2(at) + 0.5) / vec2(textureSize(from, 0)), 0.0);
}

uvec4 texel_at(usampler2D from, ivec2 at) {
    return textureLod(from, (vec2(at) + 0.5) / vec2(textureSize(from, 0)), 0.0);
}
