// Unlit pictures need no tone curve.
vec3 tone(vec3 x) {
    return clamp(x, 0.0, 1.0);
}
