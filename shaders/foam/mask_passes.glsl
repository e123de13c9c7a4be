// The mask's atlas: moments, halved levels, and their stack.

// @part atlas
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
    ivec2 at = as_int(floor(gl_FragCoord.xy));
    int x = at.x % MASK_SIZE;
    o_atlas = uvec2(word(at, x - 1) | word(at, x) << 16u, word(at, x + 1) | word(at, x + 2) << 16u);
}

// @part moments
// Where the thresholds of a texel lie: mean (1/65536) and variance (1/65536 squared) over its sixteenths of the mask's uniform
// cubic B-spline, each threshold as the share of the plane below it. In whole numbers, to the last bit those of
// masks/prefilter.py (_spline_quarters, _even, spans). docs/masks.md.
uniform usampler2D u_mask_ranks;    // floor(rank 65536 / N)
uniform sampler2D u_mask_quantiles; // row 0: an entry of the B-spline's quantile table and the next
out uvec2 o_moments;

// In steps of 1/131072, so that the middle of a rank is one.
uint doubled(ivec2 texel) {
    return 2u * texelFetch(u_mask_ranks, texel & (MASK_SIZE - 1), 0).r + uint(MASK_STEP);
}

// Times 3072 and the sum of a row of texels: 3/8 and 1/8 before the middle one and behind it.
uvec4 quarters(uint a, uint b, uint c, uint d, uint e) {
    return uvec4(
        27u * a + 1223u * b + 1697u * c + 125u * d,
        a + 725u * b + 2003u * c + 343u * d,
        343u * b + 2003u * c + 725u * d + e,
        125u * b + 1697u * c + 1223u * d + 27u * e
    );
}

// Entry i of the table and the next.
uvec2 entries(int i) {
    return uvec2(2097152.0 * texelFetch(u_mask_quantiles, ivec2(i, 0), 0).rg);
}

// The place of four thresholds in the table: how many entries behind the first are at most as great, and the two about each.
struct Place {
    uvec4 below;
    uvec4 low;
    uvec4 high;
};

// Entries come in their order.
void pass(inout Place place, uvec4 threshold, uint entry) {
    uvec4 passed = uvec4(lessThanEqual(uvec4(entry), threshold));
    place.below += passed;
    place.low = max(place.low, entry * passed);
    place.high = min(place.high, entry | (0u - passed));
}

// floor(1024 a / b), a up to b: drivers divide whole numbers one by one, in long code.
uvec4 ratio(uvec4 a, uvec4 b) {
    uvec4 near = uvec4(1024.0 * vec4(a) / vec4(b));
    ivec4 rest = ivec4(1024u * a - near * b);
    return near + uvec4(greaterThanEqual(rest, ivec4(b))) - uvec4(lessThan(rest, ivec4(0)));
}

// The shares of the plane below four thresholds, 1/16384.
uvec4 evens(Place place, uvec4 threshold) {
    uvec4 width = max(place.high - place.low, 1u);
    uvec4 part = clamp(threshold, place.low, place.low + width) - place.low;
    uvec4 even = 1024u * place.below + ratio(part, width);
    uvec4 end = min(even, 65536u - even);
    uvec4 share = (end * end + 65536u) >> 17u;
    uvec4 late = uvec4(greaterThan(even, uvec4(32768u)));
    return min(share + late * (16384u - 2u * share), 16383u);
}

uint greatest(uvec4 x) {
    return max(max(x.x, x.y), max(x.z, x.w));
}

int sum_of(ivec4 x) {
    return x.x + x.y + x.z + x.w;
}

void main() {
    ivec2 texel = as_int(floor(gl_FragCoord.xy));
    uvec4 rows[5];
    for (int j = 0; j < 5; ++j) {
        ivec2 at = texel + ivec2(-2, j - 2);
        rows[j] = quarters(
            doubled(at), doubled(at + ivec2(1, 0)), doubled(at + ivec2(2, 0)), doubled(at + ivec2(3, 0)), doubled(at + ivec2(4, 0))
        );
        rows[j] = (rows[j] + 256u) >> 9u;
    }
    uvec4 one = (27u * rows[0] + 1223u * rows[1] + 1697u * rows[2] + 125u * rows[3] + 576u) / 1152u;
    uvec4 two = (rows[0] + 725u * rows[1] + 2003u * rows[2] + 343u * rows[3] + 576u) / 1152u;
    uvec4 three = (343u * rows[1] + 2003u * rows[2] + 725u * rows[3] + rows[4] + 576u) / 1152u;
    uvec4 four = (125u * rows[1] + 1697u * rows[2] + 1223u * rows[3] + 27u * rows[4] + 576u) / 1152u;
    // Of all sixteen about 8192: their sum, and the sum of their squares.
    int total = 0;
    int squared = 0;
    for (int part = 0; part < 2; ++part) {
        uvec4 a = part == 0 ? one : three;
        uvec4 b = part == 0 ? two : four;
        uint last = max(greatest(a), greatest(b));
        uint least = ~max(greatest(~a), greatest(~b));
        // Entries that all of them pass, eight at a time.
        int start = 0;
        while (start + 8 < QUANTILES - 1 && entries(start + 8).x <= least) {
            start += 8;
        }
        Place of_a = Place(uvec4(uint(start)), uvec4(entries(start).x), uvec4(entries(QUANTILES - 2).y));
        Place of_b = of_a;
        for (int i = start + 1; i < QUANTILES - 1; i += 2) {
            uvec2 pair = entries(i);
            // The last entry is never passed.
            pair.y = i < QUANTILES - 2 ? pair.y : 0xffffffffu;
            pass(of_a, a, pair.x);
            pass(of_b, b, pair.x);
            pass(of_a, a, pair.y);
            pass(of_b, b, pair.y);
            if (pair.y > last) {
                break;
            }
        }
        ivec4 even_a = ivec4(evens(of_a, a)) - 8192;
        ivec4 even_b = ivec4(evens(of_b, b)) - 8192;
        total += sum_of(even_a + even_b);
        squared += sum_of(even_a * even_a + even_b * even_b);
    }
    int centre = (total + 8) >> 4;
    o_moments = uvec2((total + 16 * 8192 + 2) >> 2, squared - 2 * centre * total + 16 * centre * centre);
}

// @part halve
// A level of a mask's moments from the next finer one; the levels that are done already are copied. Level l, of
// MASK_SIZE >> l texels a side, begins at row MASK_SIZE - 2 (MASK_SIZE >> l). docs/masks.md.
uniform usampler2D u_mask_moments; // mean (1/65536), variance (1/65536 squared)
uniform float u_mask_side;         // of this level, texels
uniform float u_mask_finer_row;    // where the finer level begins
out uvec2 o_moments;

uvec2 finer(ivec2 texel) {
    return texelFetch(u_mask_moments, texel + ivec2(0, int(u_mask_finer_row)), 0).rg;
}

void main() {
    ivec2 at = as_int(floor(gl_FragCoord.xy));
    int side = int(u_mask_side);
    ivec2 texel = at - ivec2(0, MASK_SIZE - 2 * side);
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(side)))) {
        o_moments = texelFetch(u_mask_moments, at, 0).rg;
        return;
    }
    uvec2 a = finer(2 * texel);
    uvec2 b = finer(2 * texel + ivec2(1, 0));
    uvec2 c = finer(2 * texel + ivec2(0, 1));
    uvec2 d = finer(2 * texel + ivec2(1, 1));
    uvec2 mean = (a + b + c + d + 2u) >> 2u;
    ivec4 off = ivec4(a.x, b.x, c.x, d.x) - int(mean.x);
    uvec4 squared = uvec4(off * off);
    o_moments = uvec2(mean.x, mean.y + ((squared.x + squared.y + squared.z + squared.w + 2u) >> 2u));
}

// @part stack
// Atlases of several masks over one another, the youngest foam's first.
uniform usampler2D u_mask_atlas_0;
uniform usampler2D u_mask_atlas_1;
uniform usampler2D u_mask_atlas_2; // where there are two masks, the second once more
out uvec2 o_atlas;

void main() {
    ivec2 at = as_int(floor(gl_FragCoord.xy));
    int which = at.y / MASK_SIZE;
    at.y -= which * MASK_SIZE;
    o_atlas = which == 0 ? texelFetch(u_mask_atlas_0, at, 0).rg
        : which == 1 ? texelFetch(u_mask_atlas_1, at, 0).rg
        : texelFetch(u_mask_atlas_2, at, 0).rg;
}
