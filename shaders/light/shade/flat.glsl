// No light: water is black, foam white, as the paper's equations have them.
vec3 water_light(vec3 place, vec3 d, vec3 n, vec2 unresolved, float height, float f) {
    return vec3(0.0);
}

float shade_sun(vec3 place, Footprint fp) {
    return 1.0;
}

vec3 foam_light(vec3 n) {
    return vec3(1.0);
}

vec3 in_air(vec3 light, vec3 d, float distance_to_eye) {
    return light;
}
