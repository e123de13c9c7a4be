// No white water along hulls.
float wake_contact(int i, vec2 p, float amount, float patches, Footprint fp) {
    return 0.0;
}
