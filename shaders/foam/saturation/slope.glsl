// Foam where the water is steep (GPU ocean, 2007): f = gain (1 - n.y - base), n the waves' normal.
float slope_saturation(vec2 p, float height, Footprint fp) {
    return slope_foam(slope_lack(p, fp));
}
