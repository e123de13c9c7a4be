// Folds of the moment alone.
float fold_saturation(vec2 p, float height, Footprint fp) {
    vec4 folds = FOLD_SHARED ? sea_folded : sea_folds(p, fp);
    float f = u_fold_share[0] * fold_ramp(folds.w, sqrt(u_fold_variance.x * folds.z), u_fold[0]);
    return fold_together(f, folds.z);
}
