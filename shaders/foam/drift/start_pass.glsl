// Forward mapping, its start: what came up in each cell, every generation in a channel of its own.
uniform float u_drift_texel; // m
out vec4 o_drift;

void main() {
    vec2 q = gl_FragCoord.xy * u_drift_texel - u_drift_half;
    vec4 found = vec4(0.0);
    for (int j = 0; j < DRIFT_GENERATIONS; ++j) {
        found[j] = drift_patch(drift_generation(j), q);
    }
    o_drift = found;
}
