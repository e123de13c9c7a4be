// Thresholded saturation that fades before it pops (Yingst et al. 2011, equation 2).
float foam_amount(float f, vec2 p, Footprint fp) {
    float m = mask_threshold(p);
    return f > m ? clamp(0.5 * f - m, 0.0, 1.0) : 0.0;
}
