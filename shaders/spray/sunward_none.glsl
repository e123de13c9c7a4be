// No sun.
vec3 spray_sunward(vec2 along) {
    return vec3(0.0);
}
