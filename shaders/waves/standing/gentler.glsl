// By how much less than surface_now() says a ray meets slopes, where it leaves out waves behind stones from `from` on.
uniform sampler2D u_stone_bounds; // a row a stone; height (m), slope, second derivative (1/m) from WAKE_AWAY of its lengths on

float stones_gentler(vec3 ray, float from) {
    float sum = 0.0;
    for (int i = 0; i < STONE_COUNT; ++i) {
        float nearest = stone_nearest(i, ray, 0.0, from);
        float slope = nearest < 0.0 ? 0.0 : texel_at(u_stone_bounds, ivec2(stone_kind(i, nearest), i)).y;
        // A thousandth less: the sum that it is taken from has been rounded.
        sum += max(0.999 * texel_at(u_stone_bounds, ivec2(0, i)).y - slope, 0.0);
    }
    return sum;
}
