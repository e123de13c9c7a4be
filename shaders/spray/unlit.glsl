// No light: drops are white, as foam is.
vec3 spray_scattered(vec3 face, vec3 d, float sun, float distance_to_eye) {
    return vec3(1.0);
}

vec3 spray_onward(vec3 d, float sun, float distance_to_eye) {
    return vec3(0.0);
}
