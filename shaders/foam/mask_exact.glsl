// The mask as the paper reads it: one texel, no filter. Threshold (rank + 1/2)/N to 16 bits.
uniform usampler2D u_mask_ranks;

float mask_texel(ivec2 texel) {
    return (float(texelFetch(u_mask_ranks, texel & (MASK_SIZE - 1), 0).r) + 0.5) / 65536.0;
}

float mask_threshold(vec2 p) {
    return mask_texel(ivec2(floor(fract(mask_uv(p)) * float(MASK_SIZE))));
}
