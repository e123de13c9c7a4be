// Foam lies where it is.
vec2 front_way(vec2 p) {
    return vec2(0.0);
}
