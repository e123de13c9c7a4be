// Height of the rings, age seconds ago, m.
uniform vec4 u_spray_ring_now[RING_COUNT];   // from the centre to the eye x, z (m), age (s), what lies behind the front (m)
uniform vec4 u_spray_ring_shape[RING_COUNT]; // I0 (m), k (rad/m), omega (rad/s), b (1/s)

float rings_then(vec2 p, float age) {
    float sum = 0.0;
    for (int i = 0; i < RING_COUNT; ++i) {
        vec4 then = u_spray_ring_now[i] - vec4(0.0, 0.0, age, 0.0);
        vec2 way = p + then.xy;
        if (then.z > 0.0) {
            sum += ring_profile(way, then, u_spray_ring_shape[i]).x;
        }
    }
    return sum;
}
