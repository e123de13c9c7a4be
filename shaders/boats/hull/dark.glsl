// No light: boats are black.
vec3 boat_in_air(vec3 light, vec3 d, float distance_to_eye) {
    return light;
}

vec3 boat_light(int i, vec3 o, vec3 d, float t, BoatHit hit) {
    return vec3(0.0);
}
