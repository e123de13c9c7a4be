// Where a generation's patches come up: three octaves of value noise, cut at a threshold.
uniform float u_drift_scale; // 1 / size of a patch, 1/m
uniform vec2 u_drift_cut;    // where the cut starts and ends, of the noise

// q: m from the square's middle. In [0, 1].
float drift_patch(uint generation, vec2 q) {
    uint key = noise_hash(uint(DRIFT_SEED) ^ noise_hash(generation));
    vec2 x = q * u_drift_scale;
    vec2 turned = vec2(0.8 * x.x - 0.6 * x.y, 0.6 * x.x + 0.8 * x.y);
    float noise = 0.55 * noise_value(key, x) + 0.3 * noise_value(key + 1u, turned * 2.3) + 0.15 * noise_value(key + 2u, x * 5.1);
    return smoothstep(u_drift_cut.x, u_drift_cut.y, noise);
}
