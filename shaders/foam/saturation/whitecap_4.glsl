// Divergence at four earlier times on two tiles.
uniform sampler2D u_age_tiles; // four times of the first tile over those of the second, a row between

float whitecap_saturation(vec2 p, float height, Footprint fp) {
    vec4 seen = FOLD_SHARED ? sea_shaded : sea_resolved(p, fp);
    // The earlier divergence has no means of its own: of it the footprint resolves as much as of the present one.
    float kept = sqrt(max(1.0 - seen.z / u_whitecap_variance.z, 0.0));
    float f = u_whitecap_share[0] * fold_ramp(seen.w, sqrt(u_whitecap_variance.x * seen.z), u_whitecap[0]);
    float deviation = sqrt(u_whitecap_variance.y * seen.z);
    vec4 then = kept * (sea_fetch_four(u_age_tiles, sea_place_0(p), 0)
        + sea_fetch_four(u_age_tiles, sea_place_1(p), 1));
    for (int j = 0; j < 4; ++j) {
        f += u_whitecap_share[1 + j] * fold_ramp(then[j], deviation, u_whitecap[1]);
    }
    return fold_together(f + fold_old(p, fp), seen.z);
}
