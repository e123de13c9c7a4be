// Foam where the water is steep (GPU ocean, 2007), blurred: f = gain (1 - n.y - base), n the waves' normal.
// Read once, under a footprint as wide as the blur: from the mean square of the slopes there instead of the mean over five places.
uniform float u_slope_blur; // m

// The footprint spread by a square box: axes of the sum of both second moments, so that they stand upright on each other.
Footprint widened(Footprint fp, float side) {
    float xx = fp.x.x * fp.x.x + fp.y.x * fp.y.x;
    float yy = fp.x.y * fp.x.y + fp.y.y * fp.y.y;
    float xy = fp.x.x * fp.x.y + fp.y.x * fp.y.y;
    float middle = 0.5 * (xx + yy);
    float half_difference = 0.5 * (xx - yy);
    float root = sqrt(half_difference * half_difference + xy * xy);
    // Of the two forms of the longer axis the one that does not cancel; a circle has any.
    vec2 along = half_difference > 0.0 ? vec2(half_difference + root, xy) : vec2(xy, root - half_difference);
    along = root > 1e-6 * middle ? normalize(along) : vec2(1.0, 0.0);
    float more = side * side;
    return Footprint(sqrt(middle + root + more) * along, sqrt(max(middle - root, 0.0) + more) * vec2(-along.y, along.x));
}

float slope_saturation(vec2 p, float height, Footprint fp) {
    return slope_foam(slope_lack(p, widened(fp, SLOPE_WIDENED * u_slope_blur)));
}
