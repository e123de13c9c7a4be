// Foam that drifts, gone back for at each sample: f = amount * sum of the generations' patches, in [0, DRIFT_CAP].
float drift_saturation(vec2 p, float height, Footprint fp) {
    vec2 q = p + u_drift_place;
    float rim = drift_rim(q);
    if (rim == 0.0) {
        return 0.0;
    }
    vec4 shares = drift_shares();
    float sum = 0.0;
    for (int j = 0; j < DRIFT_GENERATIONS; ++j) {
        q = drift_origin(q, j);
        sum += shares[j] * drift_patch(drift_generation(j), q);
    }
    return min(u_drift_foam * rim * sum, DRIFT_CAP);
}
