// No waves are told apart as short.
vec3 short_bounds() {
    return vec3(0.0);
}
