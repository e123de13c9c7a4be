// Foam where the water is steep.

// @part lack
// What the waves' normal lacks of upright: 1 - n.y. What the footprint does not resolve of the slope still counts, by its mean square.
uniform float u_slope_gain;
uniform float u_slope_base;

float slope_lack(vec2 p, Footprint fp) {
    vec4 wave = waves_shading(p, fp);
    return 1.0 - inversesqrt(1.0 + dot(wave.yz, wave.yz) + wave.w);
}

// lack: of one place, or the mean of several; in [0, SLOPE_MOST].
float slope_foam(float lack) {
    return clamp(u_slope_gain * (lack - u_slope_base), 0.0, SLOPE_MOST);
}

// @part plain
// Foam where the water is steep (GPU ocean, 2007): f = gain (1 - n.y - base), n the waves' normal.
float slope_saturation(vec2 p, float height, Footprint fp) {
    return slope_foam(slope_lack(p, fp));
}

// @part widened
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

// @part blurred
// Foam where the water is steep (GPU ocean, 2007), blurred: f = gain (1 - n.y - base), n the waves' normal.
// The mean of five places, the middle and a cross around it.
uniform float u_slope_blur; // m

float slope_saturation(vec2 p, float height, Footprint fp) {
    vec2 arm = vec2(u_slope_blur, 0.0);
    float sum = 0.0;
    // In a loop: five copies of all waves would not fit the instruction caches of GPUs.
    for (int i = 0; i < 5; ++i) {
        vec2 way = i == 0 ? vec2(0.0) : i < 3 ? arm : arm.yx;
        sum += slope_lack((i & 1) == 0 ? p - way : p + way, fp);
    }
    return slope_foam(0.2 * sum);
}
