// A texel of a texture that is read by its nearest, as by texelFetch: llvmpipe takes up to three times as long for that, GPUs some
// twenty instructions more for this. So what is drawn for each sample and each step of a ray reads by this.
vec4 texel_at(sampler2D from, ivec2 at) {
    vec2 side = 1.0 / vec2(textureSize(from, 0));
    return textureLod(from, vec2(at) * side + 0.5 * side, 0.0);
}

uvec4 texel_at(usampler2D from, ivec2 at) {
    vec2 side = 1.0 / vec2(textureSize(from, 0));
    return textureLod(from, vec2(at) * side + 0.5 * side, 0.0);
}
