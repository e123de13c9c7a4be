// The traditional way: a foam texture faded by the saturation (Yingst et al. 2011, figure 7a).
float foam_amount(float f, vec2 p, Footprint fp) {
    return clamp(f, 0.0, 1.0) * foam_texture(p, fp);
}
