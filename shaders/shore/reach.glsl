// Way to the shore's floor along d (unit) from a place at height y, m: steps that cannot pass it, then Newton. 0 inside ground.
float bed_reach(vec2 p, float y, vec3 d) {
    vec2 q = shore_place(p);
    float level = length(d.xz);
    float fastest = max(u_shore_steepest[0] * level - d.y, 1e-6);
    float fine = MARCH_TOLERANCE * length(u_ray_y) * 2.0 / u_viewport.y;
    float reach = 0.0;
    float gap = 0.0;
    vec4 ground = vec4(0.0);
    for (int i = 0; i < MARCH_STEPS; ++i) {
        ground = shore_floor(q + reach * d.xz);
        gap = y + reach * d.y - ground.x;
        if (gap < fine * reach || reach > 1e5 || (d.y > 0.0 && y + reach * d.y > u_shore_top)) {
            break;
        }
        reach += gap / fastest;
    }
    // What the steps did not reach is far, or never comes.
    if (d.y > 0.0 && gap >= fine * reach) {
        return 1e6;
    }
    float limit = 4.0 * max(fine * reach, abs(gap)) / 1e-3;
    for (int i = 0; i < 3; ++i) {
        float rate = d.y - dot(ground.yz, d.xz);
        if (rate < -1e-3) {
            reach = max(reach - clamp(gap / rate, -limit, limit), 0.0);
            ground = shore_floor(q + reach * d.xz);
            gap = y + reach * d.y - ground.x;
        }
    }
    return min(reach, 1e6);
}
