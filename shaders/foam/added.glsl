// Foam is added to water and the sum clamped to a valid colour, as the paper's code does.
vec3 foam_over(vec3 water, vec3 foam, float amount) {
    return clamp(water + amount * foam, 0.0, 1.0);
}
