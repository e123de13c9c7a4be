// The grain of the map of rings: what a footprint needs to know to take their waves out. a: mean square slope of the waves here;
// r, g, b: xx, xz, zz of k k^T, weighed by it (1/m^2).
uniform vec4 u_ring_now[RING_COUNT];   // from the centre to the map's corner x, z (m), age (s), what lies behind the front (m)
uniform vec4 u_ring_shape[RING_COUNT]; // I0 (m), k (rad/m), omega (rad/s), b (1/s)
uniform float u_ring_texel;            // m
out vec4 o_grain;

void main() {
    vec2 p = gl_FragCoord.xy * u_ring_texel;
    vec4 sum = vec4(0.0);
    // Few rings reach a texel, and drivers without branches take both sides of one: so first which, then these one by one.
    for (int from = 0; from < RING_COUNT; from += RING_BLOCK) {
        uint here = 0u;
        for (int bit = 0; bit < RING_BLOCK; ++bit) {
            int i = min(from + bit, RING_COUNT - 1);
            bool moves = from + bit == i && ring_here(p + u_ring_now[i].xy, u_ring_now[i], u_ring_shape[i]);
            here |= moves ? 1u << uint(bit) : 0u;
        }
        for (; here != 0u; here &= here - 1u) {
            int i = from + ring_first(here);
            vec2 way = p + u_ring_now[i].xy;
            vec4 ring = ring_profile(way, u_ring_now[i], u_ring_shape[i]);
            float steepness = u_ring_shape[i].y * ring.w;
            vec2 k = u_ring_shape[i].y * ring.z * way;
            sum += 0.5 * steepness * steepness * vec4(k.x * k.x, k.x * k.y, k.y * k.y, 1.0);
        }
    }
    o_grain = sum;
}
