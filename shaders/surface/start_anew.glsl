// Nothing is known of the tile yet.
vec2 known_free() {
    return vec2(0.0);
}
