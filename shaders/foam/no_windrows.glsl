// No wind that gathers foam.
float windrow(vec2 p, Footprint fp) {
    return 0.0;
}
