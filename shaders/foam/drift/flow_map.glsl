// The flow read from the velocity map: exact at its texels, bilinear between them, beyond the rim as at the rim. By hand: samplers
// weigh texels in 256 steps, and a way adds that up.
uniform sampler2D u_drift_flow;

vec2 drift_velocity(vec2 q) {
    return bilinear_held(u_drift_flow, DRIFT_SIZE, (0.5 + 0.5 * q / u_drift_half) * float(DRIFT_SIZE) - 0.5).xy;
}
