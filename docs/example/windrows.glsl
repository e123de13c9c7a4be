// Foam lines along the wind (Langmuir 1938): cos^16 across it, by its harmonics, each as the footprint leaves it.
// p: m from the camera; returns a saturation.
uniform vec2 u_rows_k;         // across the wind, a turn from line to line; rad/m
uniform float u_rows_phase[1]; // k . camera position, rad
uniform float u_rows_strength;

float rows_saturation(vec2 p, float height, Footprint fp) {
    float phase = wrap_phase(u_rows_phase[0] + dot(u_rows_k, p));
    float kept = ROWS_FILTER ? wave_kept(u_rows_k, fp) : 1.0;
    float sum = float(ROWS_HARMONICS[0]);
    for (int m = 1; m <= 8; m++) {
        sum += float(ROWS_HARMONICS[m]) * pow(kept, float(m * m)) * cos(float(m) * phase);
    }
    return u_rows_strength * max(sum / 65536.0, 0.0);
}
