// Back along the flow by the classical Runge-Kutta method: where the water that is at q now was h seconds ago.
vec2 drift_back(vec2 q, float h) {
    vec2 a = drift_velocity(q);
    vec2 b = drift_velocity(q - 0.5 * h * a);
    vec2 c = drift_velocity(q - 0.5 * h * b);
    vec2 d = drift_velocity(q - h * c);
    return q - h / 6.0 * (a + 2.0 * (b + c) + d);
}

// Where it was when the next older brood came up. The youngest brood's way is shorter than a brood, the others' one each.
vec2 drift_origin(vec2 q, int j) {
    float h = (j == 0 ? u_drift_clock.y : DRIFT_BROOD) / float(DRIFT_STEPS);
    for (int i = 0; i < DRIFT_STEPS; ++i) {
        q = drift_back(q, h);
    }
    return q;
}
