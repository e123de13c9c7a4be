// No light comes through crests.
vec3 crest_light(vec3 d, vec3 absorption, float height) {
    return vec3(0.0);
}
