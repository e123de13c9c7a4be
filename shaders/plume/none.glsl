// No bubbles in the water.
vec3 aerated(vec3 body, vec3 deep, vec3 below, vec3 extinction, float cv, float f) {
    return body;
}
