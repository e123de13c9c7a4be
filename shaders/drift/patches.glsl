// Where a brood's patches come up: three octaves of value noise on a PCG hash of whole numbers (O'Neill 2014), cut at a threshold.
uniform float u_drift_scale; // 1 / size of a patch, 1/m
uniform vec2 u_drift_cut;    // where the cut starts and ends, of the noise

uint drift_hash(uint state) {
    state = state * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

float drift_corner(uint key, ivec2 cell) {
    return float(drift_hash(drift_hash(key ^ uint(cell.x)) ^ uint(cell.y)) >> 8u) / 16777216.0;
}

float drift_noise(uint key, vec2 x) {
    vec2 base = floor(x);
    vec2 t = x - base;
    t = t * t * (3.0 - 2.0 * t);
    ivec2 cell = ivec2(base);
    return mix(
        mix(drift_corner(key, cell), drift_corner(key, cell + ivec2(1, 0)), t.x),
        mix(drift_corner(key, cell + ivec2(0, 1)), drift_corner(key, cell + ivec2(1, 1)), t.x), t.y);
}

// q: m from the square's middle. In [0, 1].
float drift_patch(uint brood, vec2 q) {
    uint key = drift_hash(uint(DRIFT_SEED) ^ drift_hash(brood));
    vec2 x = q * u_drift_scale;
    vec2 turned = vec2(0.8 * x.x - 0.6 * x.y, 0.6 * x.x + 0.8 * x.y);
    float noise = 0.55 * drift_noise(key, x) + 0.3 * drift_noise(key + 1u, turned * 2.3) + 0.15 * drift_noise(key + 2u, x * 5.1);
    return smoothstep(u_drift_cut.x, u_drift_cut.y, noise);
}
