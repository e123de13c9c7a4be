// No sun to be mirrored.
vec3 glitter_light(vec3 d, vec3 n, float sigma2, float cv) {
    return vec3(0.0);
}
