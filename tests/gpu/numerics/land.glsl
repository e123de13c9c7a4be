// Of rays and beams from chance places over a shore: how deep land lies inside the way that is called free (m), whether
// land is met, and how far the way is looked along, as a share of the shore's size.
out vec4 o_start;

float share(int i) {
    uvec2 at = uvec2(gl_FragCoord.xy);
    return noise_share(noise_hash(noise_hash(noise_hash(at.x) ^ at.y) ^ uint(i)));
}

void main() {
    vec2 q = 1.4 * u_shore_size * (vec2(share(0), share(1)) - 0.5);
    float y = max(shore_floor(q).x, 0.0) + 0.05 + u_shore_top * share(2) * share(2);
    float heading = 6.2831853 * share(3);
    vec3 r = vec3(cos(heading), 0.5 * share(4) * share(4) * (share(5) - 0.7), sin(heading));
    // Rays alone, and beams of a tile's width and of many.
    float aside = share(6) < 0.3 ? 0.0 : 0.1 * share(7) * share(7);
    float raised = aside * share(8);
    float free = land_free(q, y, r, aside, raised, 0.0, 1e5);
    float far = min(free, 3.0 * u_shore_size);
    float inside = -1e9;
    for (int i = 1; i < 400; ++i) {
        float tau = far * float(i) / 400.0;
        for (int j = -2; j <= 2; ++j) {
            vec2 at = q + tau * (r.xz + 0.5 * float(j) * aside * vec2(-r.z, r.x));
            float land = shore_inside(at).x * shore_inside(at).y * shore_floor(at).x;
            inside = max(inside, land > 0.0 ? land - y - tau * (r.y - raised) : -1e9);
        }
    }
    o_start = vec4(inside, free < 1e5 ? 1.0 : 0.0, far / u_shore_size, 0.0);
}
