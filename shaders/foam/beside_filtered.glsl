// The foam amount some way beside a place, of the same saturation; of the mask alone, since its shade is soft.
float beside_amount(float f, vec2 p, vec2 way, Footprint fp) {
    foam_octaves = 1;
    return foam_amount(f, p + way, fp);
}
