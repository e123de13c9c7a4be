// What carries a boat: the drawn surface.
float boat_support(vec2 p, float draught) {
    return waves(p).x;
}
