// The atlas of a mask, as masks/prefilter.py (atlas) has it: a texel holds itself, the one before and the two behind it in its row,
// 16 bits each. The mask, beside it level 0 of the spans, beside that the other levels below one another. docs/masks.md.
uniform usampler2D u_mask_ranks;   // floor(rank 65536 / N)
uniform usampler2D u_mask_moments; // of level 0: mean (1/65536), variance (1/65536 squared)
uniform usampler2D u_mask_levels;  // of the others, level l from row MASK_SIZE - 2 (MASK_SIZE >> l) on
out uvec2 o_atlas;

// Where thresholds lie evenly with this mean and this variance: the lowest, 1/256, and the width less 1 in the upper 8 bits.
uint span(uvec2 moments) {
    uint most = (3u * moments.y) >> 12u;
    uint root = uint(sqrt(float(most)));
    // No driver's square root decides.
    root -= root * root > most ? 1u : 0u;
    root += (root + 1u) * (root + 1u) <= most ? 1u : 0u;
    uint room = (min(moments.x, 65536u - moments.x) + 64u) >> 7u;
    uint width = clamp(min((root + 1u) >> 1u, room), 1u, 256u);
    int low = clamp((int(moments.x) - 128 * int(width) + 128) >> 8, 0, 256 - int(width));
    return uint(low) | (width - 1u) << 8u;
}

// Of texel x of this row, round the torus.
uint word(ivec2 at, int x) {
    if (at.x < MASK_SIZE) {
        return texelFetch(u_mask_ranks, ivec2(x & (MASK_SIZE - 1), at.y), 0).r;
    }
    if (at.x < 2 * MASK_SIZE) {
        return span(texelFetch(u_mask_moments, ivec2(x & (MASK_SIZE - 1), at.y), 0).rg);
    }
    // Rows of level l are those from which to the end there are more than its sides and no more than twice as many.
    int side = 1;
    while (2 * side < MASK_SIZE - at.y) {
        side *= 2;
    }
    if (at.x - 2 * MASK_SIZE >= side || MASK_SIZE - at.y == 1) {
        return 0u;
    }
    return span(texelFetch(u_mask_levels, ivec2(x & (side - 1), at.y), 0).rg);
}

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    int x = at.x % MASK_SIZE;
    o_atlas = uvec2(word(at, x - 1) | word(at, x) << 16u, word(at, x + 1) | word(at, x + 2) << 16u);
}
