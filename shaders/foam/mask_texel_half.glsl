// A mask's threshold (rank + 1/2)/N as a half float: finest where thresholds are small.
uniform sampler2D u_mask_ranks;

float mask_texel(ivec2 texel) {
    return texel_at(u_mask_ranks, texel & (MASK_SIZE - 1)).r;
}
