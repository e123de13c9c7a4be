// Rings summed at the place itself: exact to float32.
uniform vec4 u_ring_now[RING_COUNT];   // from the centre to the eye x, z (m), age (s), what lies behind the front (m)
uniform vec4 u_ring_shape[RING_COUNT]; // I0 (m), k (rad/m), omega (rad/s), b (1/s)

// Height and its gradient.
vec3 rings_waves(vec2 p) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < RING_COUNT; ++i) {
        vec2 way = p + u_ring_now[i].xy;
        vec4 ring = ring_profile(way, u_ring_now[i], u_ring_shape[i]);
        sum += vec3(ring.x, ring.y * ring.z * way);
    }
    return sum;
}

// Height and gradient without what is smaller than the footprint, and the unresolved mean square slope.
vec4 rings_shading(vec2 p, Footprint fp) {
    vec4 sum = vec4(0.0);
    for (int i = 0; i < RING_COUNT; ++i) {
        vec2 way = p + u_ring_now[i].xy;
        vec4 ring = ring_profile(way, u_ring_now[i], u_ring_shape[i]);
        float kept = 1.0;
        float k = u_ring_shape[i].y;
        if (SURFACE_FILTER) {
            kept = wave_kept(k * ring.z * way, fp);
        }
        sum += vec4(kept * ring.x, kept * ring.y * ring.z * way, (1.0 - kept * kept) * 0.5 * k * k * ring.w * ring.w);
    }
    return sum;
}
