// What is left of a band of ripples under a footprint; x: k of the band (rad/m), y: its mean square slope.
uniform vec2 u_ripples_band[4];

float ripples_kept(int band, Footprint fp) {
    if (!SURFACE_FILTER) {
        return 1.0;
    }
    float k = u_ripples_band[band].x;
    return wave_kept(k * k, fp);
}

float ripples_lost(vec4 kept) {
    vec4 mss = vec4(u_ripples_band[0].y, u_ripples_band[1].y, u_ripples_band[2].y, u_ripples_band[3].y);
    return dot(mss, 1.0 - kept * kept);
}
