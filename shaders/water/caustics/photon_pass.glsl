// A photon's share in a texel: the uniform cubic B-spline around the place where it lands.
flat in vec3 v_photon;
flat in vec4 v_part;
out vec4 o_light;

float bspline(float x) {
    float a = abs(x);
    float b = max(2.0 - a, 0.0);
    return a < 1.0 ? (4.0 - 6.0 * a * a + 3.0 * a * a * a) / 6.0 : b * b * b / 6.0;
}

void main() {
    vec2 way = gl_FragCoord.xy - v_photon.xy;
    o_light = bspline(way.x) * bspline(way.y) * v_photon.z * v_part;
}
