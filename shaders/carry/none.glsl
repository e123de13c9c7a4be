// Off a coast too water lies where it rests.
vec2 carry(vec2 p) {
    return vec2(0.0);
}
