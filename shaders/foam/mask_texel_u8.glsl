// A mask's threshold (rank + 1/2)/N to 8 bits: a 256th of all bubbles pops at once.
uniform usampler2D u_mask_ranks;

float mask_texel(ivec2 texel) {
    return (float(texel_at(u_mask_ranks, texel & (MASK_SIZE - 1)).r) + 0.5) / 256.0;
}
