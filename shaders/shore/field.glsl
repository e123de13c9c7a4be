// The map of the shore at a place: values and gradients, a quadratic B-spline of its texels.
// r phase (periods), g height (m), b skew (0 to 1), a share of the open sea's waves.
uniform sampler2D u_shore_map;

struct ShoreField {
    vec4 here;
    vec4 along_x; // change a metre
    vec4 along_z;
};

ShoreField shore_field(vec2 q) {
    vec2 at = shore_texel(q, float(MAP_TEXELS));
    vec2 base = floor(at + 0.5);
    vec2 t = at + 0.5 - base;
    vec3 wx = bspline_weights(t.x);
    vec3 wz = bspline_weights(t.y);
    vec3 sx = bspline_slopes(t.x);
    vec3 sz = bspline_slopes(t.y);
    ShoreField sum = ShoreField(vec4(0.0), vec4(0.0), vec4(0.0));
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) {
            ivec2 texel = clamp(ivec2(base) + ivec2(i - 1, j - 1), ivec2(0), ivec2(MAP_TEXELS - 1));
            vec4 value = texelFetch(u_shore_map, texel, 0);
            sum.here += wx[i] * wz[j] * value;
            sum.along_x += sx[i] * wz[j] * value;
            sum.along_z += wx[i] * sz[j] * value;
        }
    }
    vec2 scale = float(MAP_TEXELS) / u_shore_size * shore_inside(q);
    sum.along_x *= scale.x;
    sum.along_z *= scale.y;
    return sum;
}
