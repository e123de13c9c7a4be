// Folds of four earlier times on two tiles.
uniform sampler2D u_age_tiles; // four times of the first tile over those of the second, a row between

float fold_saturation(vec2 p, float height, Footprint fp) {
    vec4 folds = FOLD_SHARED ? sea_folded : sea_folds(p, fp);
    // Earlier folds have no means of their own: what the footprint lost of the fold now, it takes from them.
    float kept = sqrt(max(1.0 - folds.z / u_fold_variance.z, 0.0));
    float f = u_fold_share[0] * fold_ramp(folds.w, sqrt(u_fold_variance.x * folds.z), u_fold[0]);
    float deviation = sqrt(u_fold_variance.y * folds.z);
    vec4 then = kept * (sea_fetch_four(u_age_tiles, sea_place_0(p), 0)
        + sea_fetch_four(u_age_tiles, sea_place_1(p), 1));
    for (int j = 0; j < 4; ++j) {
        f += u_fold_share[1 + j] * fold_ramp(then[j], deviation, u_fold[1]);
    }
    return fold_together(f + fold_old(p, fp), folds.z);
}
