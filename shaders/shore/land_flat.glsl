// No light: land is black, as water is.
vec3 land_light(vec3 d, vec3 level, Soil soil, float sun) {
    return vec3(0.0);
}
