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
