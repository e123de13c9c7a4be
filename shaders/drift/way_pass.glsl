// The ways back to where the two youngest broods came up, m: r, g the youngest's, b, a the next.
uniform float u_drift_texel; // m
out vec4 o_way;

void main() {
    vec2 q = gl_FragCoord.xy * u_drift_texel - u_drift_half;
    vec2 first = drift_origin(q, 0);
    o_way = vec4(first - q, drift_origin(first, 1) - q);
}
