// How many texels of a tile lie under a footprint, as a power of 2: 0 is the tile itself, above SEA_LEVELS nothing of it is left.
float sea_level(float side, Footprint fp) {
    if (!SURFACE_FILTER) {
        return 0.0;
    }
    float longer = sqrt(max(dot(fp.x, fp.x), dot(fp.y, fp.y)));
    float area = abs(fp.x.x * fp.y.y - fp.x.y * fp.y.x);
    float width = area / max(longer, 1e-30);
    // As wide as the footprint's area: by its longer side short waves would go that it tells apart across. Clamped to so many times its
    // width: on a crest's edge a footprint is endlessly long. A trilinear read has three times the variance of a box of its texels:
    // SEA_READ is the root of a third, and more where one sample stands for a pixel, because it sees one of the crests there.
    float side_seen = SEA_READ * min(sqrt(area), 4.0 * width);
    // Two logarithms, of which every tile shares the first.
    return clamp(log2(max(side_seen * float(SEA_SIZE), 1e-6)) - log2(side), -1.0, float(SEA_LEVELS + 1));
}
