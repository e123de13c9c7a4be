// No boat moves: no foam behind it.
float wake_saturation(vec2 p, float height, Footprint fp) {
    return 0.0;
}
