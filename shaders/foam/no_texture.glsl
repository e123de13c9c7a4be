// The foam texture does not show.
float foam_texture(vec2 p, Footprint fp) {
    return 1.0;
}
