// Foam covers water.
vec3 foam_over(vec3 water, vec3 foam, float amount) {
    return mix(water, foam, amount);
}
