// The foam amount some way beside a place, of the same saturation and on the same water; of the mask alone, since its shade is soft.
float beside_amount(float f, vec2 p, vec2 way, Footprint fp) {
    foam_octaves = 1;
    return lying_amount(foam_share_lying(f, p, fp), clamp(f, 0.0, 1.0), p + carry(p) + way, fp);
}
