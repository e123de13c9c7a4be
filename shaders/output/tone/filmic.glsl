// Filmic tone curve (Narkowicz 2015, a fit to ACES), from linear light to display light in [0, 1].
vec3 tone(vec3 x) {
    return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}
