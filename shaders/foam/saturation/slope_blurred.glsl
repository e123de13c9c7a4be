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
