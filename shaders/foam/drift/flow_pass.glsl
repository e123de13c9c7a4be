// The velocity map: m/s over the square.
uniform float u_drift_texel; // m
out vec4 o_flow;

void main() {
    o_flow = vec4(drift_velocity(gl_FragCoord.xy * u_drift_texel - u_drift_half), 0.0, 0.0);
}
