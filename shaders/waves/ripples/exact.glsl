// Ripples summed at the point itself: exact to float32.
uniform vec4 u_ripples_wave[2 * RIPPLE_COPIES * RIPPLE_WAVES]; // k.x, k.z (rad/m), slope, band
uniform float u_ripples_phase[2 * RIPPLE_COPIES * RIPPLE_WAVES];

// Gradient, and the unresolved mean square slope.
vec3 ripples_detail(vec2 p, Footprint fp) {
    vec4 kept = vec4(ripples_kept(0, fp), ripples_kept(1, fp), ripples_kept(2, fp), ripples_kept(3, fp));
    vec2 slope = vec2(0.0);
    for (int i = 0; i < 2 * RIPPLE_COPIES * RIPPLE_WAVES; ++i) {
        vec4 wave = u_ripples_wave[i];
        float amount = -kept[int(wave.w)] * wave.z * whole_sine_cosine(wrap_phase(u_ripples_phase[i] - dot(wave.xy, p))).y;
        slope += amount * normalize(wave.xy);
    }
    return vec3(slope, ripples_lost(kept));
}
