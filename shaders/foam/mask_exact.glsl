// The mask as the paper reads it: one texel, no filter.
float mask_threshold(vec2 p) {
    return mask_texel(ivec2(floor(fract(mask_uv(p)) * float(MASK_SIZE))));
}
