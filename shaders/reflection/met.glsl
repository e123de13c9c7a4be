// What a ray meets over the water from o along d (unit), m away, and its light; negative: nothing but the sky.
float mirror_met(vec3 o, vec3 d, bool far, out vec3 light) {
    float boat = boats_met(o, d, far, light);
    vec3 other;
    float land = land_met(o, d, other);
    if (land >= 0.0 && (boat < 0.0 || land < boat)) {
        light = other;
        return land;
    }
    return boat;
}
