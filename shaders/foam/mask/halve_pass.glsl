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
    ivec2 at = ivec2(gl_FragCoord.xy);
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
