// The foam amount some way beside a place, of the same saturation.
float beside_amount(float f, vec2 p, vec2 way, Footprint fp) {
    return foam_amount(f, p + way, fp);
}
