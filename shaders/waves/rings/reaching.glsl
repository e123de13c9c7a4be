// Which rings reach a texel of a map of rings. Few do, and drivers without branches take both sides of one: so first which, a block at a
// time, then these one by one.
uniform vec4 u_ring_now[RING_COUNT];   // from the centre to the map's corner x, z (m), age (s), what lies behind the front (m)
uniform vec4 u_ring_shape[RING_COUNT]; // I0 (m), k (rad/m), omega (rad/s), b (1/s)
uniform float u_ring_texel;            // m

// A bit for each ring of the block that begins with `from`; p: from the map's corner, m.
uint rings_reaching(vec2 p, int from) {
    uint here = 0u;
    for (int bit = 0; bit < RING_BLOCK; ++bit) {
        int i = min(from + bit, RING_COUNT - 1);
        bool moves = from + bit == i && ring_here(p + u_ring_now[i].xy, u_ring_now[i], u_ring_shape[i]);
        here |= moves ? 1u << uint(bit) : 0u;
    }
    return here;
}
