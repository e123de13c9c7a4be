// Water without a floor: what it scatters back alone.
vec3 water_body(vec3 below, vec3 deep, vec3 extinction, float cv, float height) {
    return deep;
}
