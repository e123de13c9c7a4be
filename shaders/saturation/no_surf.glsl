// No shore, no surf.
float surf_saturation(vec2 p, float height, Footprint fp) {
    return 0.0;
}
