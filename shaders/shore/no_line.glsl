// No foam on the sand.
float land_foam(vec2 p, float ground, Footprint fp) {
    return 0.0;
}
