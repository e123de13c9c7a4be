// No moon.
vec3 moon_glow(vec3 d) {
    return vec3(0.0);
}
