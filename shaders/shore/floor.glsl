// Height of floor or land over y = 0 (m) and its gradient: a quadratic B-spline of the height field's texels.
// w: tint in [0, 1]. q: metres from the middle of the square.
uniform sampler2D u_shore_floor; // height (m), tint

vec4 shore_floor(vec2 q) {
    vec2 at = shore_texel(q, float(FLOOR_TEXELS));
    vec2 base = floor(at + 0.5);
    vec2 t = at + 0.5 - base;
    vec3 wx = bspline_weights(t.x);
    vec3 wz = bspline_weights(t.y);
    vec3 sx = bspline_slopes(t.x);
    vec3 sz = bspline_slopes(t.y);
    vec4 sum = vec4(0.0);
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) {
            ivec2 texel = clamp(ivec2(base) + ivec2(i - 1, j - 1), ivec2(0), ivec2(FLOOR_TEXELS - 1));
            vec2 here = texelFetch(u_shore_floor, texel, 0).rg;
            sum += vec4(here.x * wx[i] * wz[j], here.x * sx[i] * wz[j], here.x * wx[i] * sz[j], here.y * wx[i] * wz[j]);
        }
    }
    sum.yz *= float(FLOOR_TEXELS) / u_shore_size * shore_inside(q);
    return sum;
}
