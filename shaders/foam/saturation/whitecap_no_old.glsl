// Foam does not last.
float fold_old(vec2 p, Footprint fp) {
    return 0.0;
}
