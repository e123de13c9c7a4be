// Ripples summed at the point itself: exact to float32.
uniform vec4 u_chop_wave[2 * CHOP_WAVES]; // k.x, k.z (rad/m), slope, band
uniform float u_chop_phase[2 * CHOP_WAVES];

// Gradient, and the unresolved mean square slope.
vec3 chop_detail(vec2 p, Footprint fp) {
    vec4 kept = vec4(chop_kept(0, fp), chop_kept(1, fp), chop_kept(2, fp), chop_kept(3, fp));
    vec2 slope = vec2(0.0);
    for (int i = 0; i < 2 * CHOP_WAVES; ++i) {
        vec4 wave = u_chop_wave[i];
        float amount = -kept[int(wave.w)] * wave.z * whole_sine_cosine(wrap_phase(u_chop_phase[i] - dot(wave.xy, p))).y;
        slope += amount * normalize(wave.xy);
    }
    return vec3(slope, chop_lost(kept));
}
