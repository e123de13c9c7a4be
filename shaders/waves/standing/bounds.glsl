// Bounds of the standing waves as their map holds them.
uniform sampler2D u_stone_bounds; // a row a stone; height (m), slope, second derivative (1/m) from WAKE_AWAY of its lengths on

vec3 stones_bounds(vec3 ray, float aside, float from) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < STONE_COUNT; ++i) {
        sum.xy += texel_at(u_stone_bounds, ivec2(0, i)).xy;
        float nearest = stone_nearest(i, ray, aside, from);
        sum.z += nearest < 0.0 ? 0.0 : texel_at(u_stone_bounds, ivec2(stone_kind(i, nearest), i)).z;
    }
    return sum;
}
