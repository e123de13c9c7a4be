// Back along the flow by the classical Runge-Kutta method: where the water that is at q now was h seconds ago.
vec2 drift_back(vec2 q, float h) {
    vec2 a = drift_velocity(q);
    vec2 b = drift_velocity(q - 0.5 * h * a);
    vec2 c = drift_velocity(q - 0.5 * h * b);
    vec2 d = drift_velocity(q - h * c);
    return q - h / 6.0 * (a + 2.0 * (b + c) + d);
}

// Where the water that is at q now was that many seconds ago, in steps as long as those of a generation or shorter.
vec2 drift_ago(vec2 q, float seconds) {
    int steps = max(int(ceil(seconds * (float(DRIFT_STEPS) / DRIFT_GENERATION) - 1e-3)), 1);
    float h = seconds / float(steps);
    for (int i = 0; i < steps; ++i) {
        q = drift_back(q, h);
    }
    return q;
}
