// No single waves.
vec4 fronts_then(vec2 p, float age) {
    return vec4(0.0);
}
