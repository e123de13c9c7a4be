// No foam.
float foam_amount(float f, vec2 p, Footprint fp) {
    return 0.0;
}
