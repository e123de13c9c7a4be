// Dynamic displacement mapping (Kryachko 2005): the rings' heights and slopes, drawn each frame into a map that lies still on
// the water. r: height over still water (m), g, b: gradient.
out vec4 o_ring;

void main() {
    vec2 p = gl_FragCoord.xy * u_ring_texel;
    vec3 sum = vec3(0.0);
    for (int from = 0; from < RING_COUNT; from += RING_BLOCK) {
        for (uint here = rings_reaching(p, from); here != 0u; here &= here - 1u) {
            int i = from + ring_first(here);
            vec2 way = p + u_ring_now[i].xy;
            vec4 ring = ring_profile(way, u_ring_now[i], u_ring_shape[i]);
            sum += vec3(ring.x, ring.y * ring.z * way);
        }
    }
    o_ring = vec4(sum, 0.0);
}
