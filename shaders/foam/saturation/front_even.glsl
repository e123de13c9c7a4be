// Fronts foam alike everywhere.
float front_patch(vec2 q, Footprint fp) {
    return 0.0;
}
