// Foam of stones in a current: a cushion on the upstream face, and white water that the current carries away. f in [0, WAKE_CAP].
uniform vec4 u_stone_foam[STONE_COUNT]; // amount, way to 1/e (m), amount of the cushion, 0

float stones_saturation(vec2 p, float height, Footprint fp) {
    float sum = 0.0;
    for (int i = 0; i < STONE_COUNT; ++i) {
        vec4 foam = u_stone_foam[i];
        float radius = u_stone_form[i].y;
        float size = 4.0 * radius;
        StoneWay way = stone_way(i, p);
        float x = way.behind / radius - 1.0;
        float z = way.aside / radius;
        vec2 on = (p + u_stone_course[i].xy) / size;
        vec2 turned = vec2(0.8 * on.x - 0.6 * on.y, 0.6 * on.x + 0.8 * on.y);
        vec2 torn = torn_noise(TORN_NONE, 0.4, 0.31 * size, noise_value(NOISE_KEY, on / 0.31), fp);
        torn = torn_noise(torn, 0.35, 0.11 * size, noise_value(NOISE_KEY, turned / 0.11), fp);
        torn = torn_noise(torn, 0.25, 0.037 * size, noise_value(NOISE_KEY, on / 0.037), fp);
        float patches = torn_step(0.25, 0.72, torn.x, torn.y);
        float along = torn_variance(way.on_behind, radius, fp);
        float across = torn_variance(way.on_aside, radius, fp);
        float width = 0.9 + 0.2 * sqrt(max(x, 0.0));
        float band = torn_step(-1.2 * width, -0.6 * width, z, across) - torn_step(0.6 * width, 1.2 * width, z, across);
        band *= torn_step(-0.7, 0.3, x, along) * exp(-min(max(x, 0.0) * radius / foam.y, 80.0));
        // A bell about the rim, wider over a footprint.
        float off = length(vec2(x, z)) - 1.0;
        float wider = 1.0 + 2.0 * (along + across) / 0.0625;
        float rim = exp(-min(off * off / (0.0625 * wider), 80.0)) * inversesqrt(wider);
        float cushion = rim * (1.0 - torn_step(-0.5, 0.5, x, along));
        sum += foam.x * band * (0.3 + 0.9 * patches) + foam.z * cushion * (0.3 + patches);
    }
    return min(sum, WAKE_CAP);
}
