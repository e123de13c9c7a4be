// Bounds that stones alone state of their waves.
uniform float u_stone_highest; // m
uniform vec3 u_stone_bounds[STONE_COUNT]; // slope; second derivative near the stone, and elsewhere (1/m)

vec3 stones_bounds(vec3 ray, float aside, float from) {
    vec3 sum = vec3(u_stone_highest, 0.0, 0.0);
    for (int i = 0; i < STONE_COUNT; ++i) {
        vec3 bounds = u_stone_bounds[i];
        float nearest = stone_nearest(i, ray, aside, from);
        sum.y += bounds.x;
        sum.z += nearest < 0.0 ? 0.0 : nearest < (WAKE_NEAR + 1.0) * u_stone_form[i].x ? bounds.y : bounds.z;
    }
    return sum;
}
