// No light: drops are white, as foam is.
vec3 spray_light(vec3 d, float distance_to_eye) {
    return vec3(1.0);
}
