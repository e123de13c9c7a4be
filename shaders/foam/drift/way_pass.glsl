// The ways back to where the two youngest generations came up, m: r, g the youngest's, b, a the next.
uniform float u_drift_texel;     // m
uniform sampler2D u_drift_still; // where it was whole quarters of a generation ago, and a generation before that
out vec4 o_way;

void main() {
    vec2 q = gl_FragCoord.xy * u_drift_texel - u_drift_half;
    vec4 still = texel_at(u_drift_still, drift_still_texel());
    o_way = vec4(drift_rest(still.xy) - q, drift_rest(still.zw) - q);
}
