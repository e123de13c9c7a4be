// No stars.
vec3 star_light(vec3 d, float pixel) {
    return vec3(0.0);
}
