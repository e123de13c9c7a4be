// Thresholded, fading and textured (Yingst et al. 2011, equation 3).
float foam_amount(float f, vec2 p, Footprint fp) {
    float m = mask_threshold(p);
    return f > m ? clamp(0.5 * f - m, 0.0, 1.0) * foam_texture(p, fp) : 0.0;
}
