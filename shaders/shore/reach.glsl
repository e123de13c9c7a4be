// Way to the shore's floor along d (unit) from a place at height y, m. 0 inside ground.
float bed_reach(vec2 p, float y, vec3 d) {
    vec2 q = shore_place(p);
    float fine = march_tolerance();
    float leave = d.y > 0.0 ? min(max(u_shore_top - y, 0.0) / d.y, 1e5) : 1e5;
    float reach = 0.0;
    float before;
    float gap;
    vec4 ground;
    march_ground(q, y, d, leave, fine, 0.0, false, reach, before, gap, ground);
    // What the steps did not reach is far, or never comes.
    if (d.y > 0.0 && gap >= fine * reach) {
        return 1e6;
    }
    refine_ground(q, y, d, 1.0, fine, 0.0, 3, false, reach, gap, ground);
    return min(reach, 1e6);
}
