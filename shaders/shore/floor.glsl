// Height of floor or land over y = 0 (m) and its gradient. w: tint in [0, 1]. q: metres from the middle of the square.
uniform sampler2D u_shore_floor; // height (m), tint

vec4 shore_floor(vec2 q) {
    SplineTaps taps = spline_taps(q, FLOOR_TEXELS);
    vec4 sum = vec4(0.0);
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) {
            vec2 here = spline_texel(u_shore_floor, FLOOR_TEXELS, taps, i, j).rg;
            // Not by products of weights: shared with those of the map at the same place they would be kept in registers.
            sum += vec4(
                here.x * taps.wx[i] * taps.wz[j], here.x * taps.sx[i] * taps.wz[j], here.x * taps.wx[i] * taps.sz[j],
                here.y * taps.wx[i] * taps.wz[j]);
        }
    }
    sum.yz *= taps.scale;
    return sum;
}
