// Dynamic displacement mapping (Kryachko 2005): the rings' heights and slopes, drawn each frame into a map that lies still on
// the water. r: height over still water (m), g, b: gradient.
uniform vec4 u_ring_now[RING_COUNT];   // from the centre to the map's corner x, z (m), age (s), what lies behind the front (m)
uniform vec4 u_ring_shape[RING_COUNT]; // I0 (m), k (rad/m), omega (rad/s), b (1/s)
uniform float u_ring_texel;            // m
out vec4 o_ring;

void main() {
    vec2 p = gl_FragCoord.xy * u_ring_texel;
    vec3 sum = vec3(0.0);
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
            sum += vec3(ring.x, ring.y * ring.z * way);
        }
    }
    o_ring = vec4(sum, 0.0);
}
