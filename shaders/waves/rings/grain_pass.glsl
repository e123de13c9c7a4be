// The grain of the map of rings: what a footprint needs to know to take their waves out. a: mean square slope of the waves here;
// r, g, b: xx, xz, zz of k k^T, weighed by it (1/m^2).
out vec4 o_grain;

void main() {
    vec2 p = gl_FragCoord.xy * u_ring_texel;
    vec4 sum = vec4(0.0);
    for (int from = 0; from < RING_COUNT; from += RING_BLOCK) {
        for (uint here = rings_reaching(p, from); here != 0u; here &= here - 1u) {
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
