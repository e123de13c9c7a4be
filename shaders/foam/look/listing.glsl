// The code that the paper prints (Yingst et al. 2011, "Applying the Mask"); it differs from its equation 3.
float foam_amount(float f, vec2 p, Footprint fp) {
    float m = mask_threshold(p);
    return f > m ? clamp(f - m, 0.15, 3.0) * foam_texture(p, fp) : 0.0;
}
