// No moon.
vec4 moon_disc(vec3 d) {
    return vec4(0.0);
}
