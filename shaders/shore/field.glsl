// What shore waves know of a place, and its gradients.
// r phase (periods), g height (m), b skew (0 to 1), a share of the open sea's waves. q: metres from the middle of the square.
uniform sampler2D u_shore_map;

struct ShoreField {
    vec4 here;
    vec4 along_x; // change a metre
    vec4 along_z;
};

ShoreField shore_field(vec2 q) {
    SplineTaps taps = spline_taps(q, MAP_TEXELS);
    ShoreField sum = ShoreField(vec4(0.0), vec4(0.0), vec4(0.0));
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) {
            vec4 value = spline_texel(u_shore_map, MAP_TEXELS, taps, i, j);
            sum.here += taps.wx[i] * taps.wz[j] * value;
            sum.along_x += taps.sx[i] * taps.wz[j] * value;
            sum.along_z += taps.wx[i] * taps.sz[j] * value;
        }
    }
    sum.along_x *= taps.scale.x;
    sum.along_z *= taps.scale.y;
    return sum;
}
