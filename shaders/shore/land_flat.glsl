// No light: land is black, as water is.
vec3 land_light(vec3 d, vec3 n, vec3 albedo, float wet) {
    return vec3(0.0);
}
