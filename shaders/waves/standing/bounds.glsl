// Bounds of the standing waves as their map holds them.
uniform sampler2D u_stone_bounds; // a row a stone; height (m), slope, second derivative (1/m) from WAKE_AWAY of its lengths on

vec3 stones_bounds(vec3 ray, float aside, float from) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < STONE_COUNT; ++i) {
        sum.xy += texelFetch(u_stone_bounds, ivec2(0, i), 0).xy;
        float nearest = stone_nearest(i, ray, aside, from);
        // As far behind the edge as bounds_join_pass.glsl counts from it.
        float away = nearest * (1.0 + WAKE_ASIDE) / u_stone_form[i].x + 1.0;
        int kind = away < float(WAKE_AWAY[1]) ? 0 : away < float(WAKE_AWAY[2]) ? 1 : away < float(WAKE_AWAY[3]) ? 2 : 3;
        sum.z += nearest < 0.0 ? 0.0 : texelFetch(u_stone_bounds, ivec2(kind, i), 0).z;
    }
    return sum;
}
