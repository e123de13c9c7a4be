// The flow read from the velocity map: exact at its texels, bilinear between them, beyond the rim as at the rim. By hand: samplers
// weigh texels in 256 steps, and a way adds that up.
uniform sampler2D u_drift_flow;

vec2 drift_velocity(vec2 q) {
    vec2 at = clamp((0.5 + 0.5 * q / u_drift_half) * float(DRIFT_SIZE) - 0.5, 0.0, float(DRIFT_SIZE - 1));
    ivec2 low = ivec2(at);
    ivec2 high = min(low + 1, DRIFT_SIZE - 1);
    vec2 t = at - vec2(low);
    return mix(
        mix(texelFetch(u_drift_flow, low, 0).xy, texelFetch(u_drift_flow, ivec2(high.x, low.y), 0).xy, t.x),
        mix(texelFetch(u_drift_flow, ivec2(low.x, high.y), 0).xy, texelFetch(u_drift_flow, high, 0).xy, t.x), t.y);
}
