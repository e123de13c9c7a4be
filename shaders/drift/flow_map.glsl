// The flow read from the velocity map: exact at its texels, bilinear between them, beyond the rim as at the rim.
uniform sampler2D u_drift_flow;

vec2 drift_velocity(vec2 q) {
    return textureLod(u_drift_flow, 0.5 + 0.5 * q / u_drift_half, 0.0).xy;
}
