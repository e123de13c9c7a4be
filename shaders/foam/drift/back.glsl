// Where it was when the next older brood came up. The youngest brood's way is shorter than a brood, the others' one each.
vec2 drift_origin(vec2 q, int j) {
    return drift_ago(q, j == 0 ? u_drift_clock.y : DRIFT_BROOD);
}
