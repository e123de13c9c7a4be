// No flow to carry foam.
float drift_saturation(vec2 p, float height, Footprint fp) {
    return 0.0;
}
