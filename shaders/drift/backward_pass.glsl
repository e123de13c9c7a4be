// Backward mapping: each texel goes back along the flow to where its water was when each brood came up, and takes what came up
// there. Every texel gets a value, whatever the step. r, g, b, a: the broods, the youngest first.
uniform float u_drift_texel;    // m
uniform float u_drift_coverage; // mean of a patch
out vec4 o_drift;

void main() {
    vec2 q = gl_FragCoord.xy * u_drift_texel - u_drift_half;
    vec4 found = vec4(0.0);
    for (int j = 0; j < DRIFT_BROODS; ++j) {
        q = drift_origin(q, j);
        // What the flow has wound finer than texels is their mean.
        float reach = max(length(dFdx(q)), length(dFdy(q))) * u_drift_scale;
        found[j] = mix(drift_patch(drift_brood(j), q), u_drift_coverage, smoothstep(0.5, 2.0, reach));
    }
    o_drift = found;
}
