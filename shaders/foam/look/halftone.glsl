// Thresholded saturation (Yingst et al. 2011, equation 1).
float foam_amount(float f, vec2 p, Footprint fp) {
    return f > mask_threshold(p) ? 1.0 : 0.0;
}
