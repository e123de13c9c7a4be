// Divergence of the moment alone.
float whitecap_saturation(vec2 p, float height, Footprint fp) {
    vec4 seen = FOLD_SHARED ? sea_shaded : sea_resolved(p, fp);
    float f = u_whitecap_share[0] * fold_ramp(seen.w, sqrt(u_whitecap_variance.x * seen.z), u_whitecap[0]);
    return fold_together(f, seen.z);
}
