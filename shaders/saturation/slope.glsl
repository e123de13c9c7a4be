// Foam where the water is steep (GPU ocean, 2007): f = gain (1 - n.y - base), n the waves' normal; f in [0, SLOPE_MOST].
// What the footprint has taken out of the slope still counts, by its mean square.
uniform float u_slope_gain;
uniform float u_slope_base;

float slope_lack(vec2 p, Footprint fp) {
    vec4 wave = waves_shading(p, fp);
    return 1.0 - inversesqrt(1.0 + dot(wave.yz, wave.yz) + wave.w);
}

float slope_saturation(vec2 p, float height, Footprint fp) {
    return clamp(u_slope_gain * (slope_lack(p, fp) - u_slope_base), 0.0, SLOPE_MOST);
}
