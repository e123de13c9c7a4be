// Rings of touches, summed at the place itself: slopes without height. Their shape follows from their strength alone, so that the list
// of touches can change while a program stays. docs/formulae.md, section 2.
uniform vec4 u_touch[TOUCH_COUNT]; // from the centre to the eye x, z (m), age (s), strength I0 (m); 0: no touch

// Gradient, and the unresolved mean square slope.
vec3 touches_detail(vec2 p, Footprint fp) {
    vec3 sum = vec3(0.0);
    // None if the first entry is empty. A bound that compilers know would have them write all rings out, which takes minutes.
    int count = u_touch[0].w > 0.0 ? TOUCH_COUNT : 0;
    for (int i = 0; i < count; ++i) {
        vec4 touch = u_touch[i];
        float wavelength = TOUCH_LEAST_LENGTH + TOUCH_LENGTH * touch.w;
        float k = TAU / wavelength;
        vec4 now = vec4(touch.xyz, TOUCH_CRESTS * wavelength);
        vec4 shape = vec4(touch.w, k, sqrt(TOUCH_GRAVITY * k), TOUCH_DECAY);
        vec2 way = p + touch.xy;
        // Of the rings few reach a place, and of a short list most entries are empty.
        if (touch.w <= 0.0 || !ring_here(way, now, shape)) {
            continue;
        }
        vec4 ring = ring_profile(way, now, shape);
        float kept = SURFACE_FILTER ? wave_kept(k * ring.z * way, fp) : 1.0;
        sum += vec3(kept * ring.y * ring.z * way, (1.0 - kept * kept) * 0.5 * k * k * ring.w * ring.w);
    }
    return sum;
}
