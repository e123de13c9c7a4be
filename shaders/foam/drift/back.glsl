// Where it was when the next older generation came up. The youngest generation's way is shorter than a generation, the others' one each.
vec2 drift_origin(vec2 q, int j) {
    return drift_ago(q, j == 0 ? u_drift_clock.y : DRIFT_GENERATION);
}
