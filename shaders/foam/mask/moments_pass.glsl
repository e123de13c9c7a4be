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

vec2 entry(int i) {
    return 2097152.0 * texelFetch(u_mask_quantiles, ivec2(i, 0), 0).rg;
}

uvec4 entries(ivec4 i) {
    return uvec4(entry(i.x).x, entry(i.y).x, entry(i.z).x, entry(i.w).x);
}

uvec4 entries_behind(ivec4 i) {
    return uvec4(entry(i.x).y, entry(i.y).y, entry(i.z).y, entry(i.w).y);
}

// Of four sums the shares of the plane below those thresholds, 1/16384.
uvec4 evens(uvec4 sum) {
    uvec4 threshold = (sum + 576u) / 1152u;
    ivec4 below = ivec4(0);
    ivec4 above = ivec4(QUANTILES - 1);
    // A loop of a known number of rounds would be unrolled for each sum, and take drivers minutes to translate.
    while (any(greaterThan(above - below, ivec4(1)))) {
        ivec4 middle = (below + above) / 2;
        ivec4 right = ivec4(lessThanEqual(entries(middle), threshold));
        below += right * (middle - below);
        above -= (1 - right) * (above - middle);
    }
    uvec4 low = entries(below);
    uvec4 width = max(entries_behind(below) - low, 1u);
    uvec4 part = clamp(threshold, low, low + width) - low;
    uvec4 place = uvec4(below) * 1024u + part * 1024u / width;
    uvec4 end = min(place, 65536u - place);
    uvec4 share = (end * end + 65536u) >> 17u;
    uvec4 late = uvec4(greaterThan(place, uvec4(32768u)));
    return min(share + late * (16384u - 2u * share), 16383u);
}

uint sum_of(uvec4 x) {
    return x.x + x.y + x.z + x.w;
}

uint squares(uvec4 x, uint centre) {
    ivec4 off = ivec4(x) - int(centre);
    return sum_of(uvec4(off * off));
}

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    uvec4 rows[5];
    for (int j = 0; j < 5; ++j) {
        ivec2 at = texel + ivec2(-2, j - 2);
        rows[j] = quarters(
            doubled(at), doubled(at + ivec2(1, 0)), doubled(at + ivec2(2, 0)), doubled(at + ivec2(3, 0)), doubled(at + ivec2(4, 0))
        );
        rows[j] = (rows[j] + 256u) >> 9u;
    }
    uvec4 one = evens(27u * rows[0] + 1223u * rows[1] + 1697u * rows[2] + 125u * rows[3]);
    uvec4 two = evens(rows[0] + 725u * rows[1] + 2003u * rows[2] + 343u * rows[3]);
    uvec4 three = evens(343u * rows[1] + 2003u * rows[2] + 725u * rows[3] + rows[4]);
    uvec4 four = evens(125u * rows[1] + 1697u * rows[2] + 1223u * rows[3] + 27u * rows[4]);
    uint total = sum_of(one + two + three + four);
    uint centre = (total + 8u) >> 4u;
    uint variance = squares(one, centre) + squares(two, centre) + squares(three, centre) + squares(four, centre);
    o_moments = uvec2((total + 2u) >> 2u, variance);
}
