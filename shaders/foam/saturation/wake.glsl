// Foam of boats: the churned band behind the stern, dying away in patches, what the bow throws aside, and what lies along the hull. f in [0, WAKE_CAP].
uniform vec4 u_wake_foam[BOAT_COUNT]; // amount, way to 1/e (m), amount at the bow, amount along the hull

float wake_saturation(vec2 p, float height, Footprint fp) {
    float sum = 0.0;
    for (int i = 0; i < BOAT_COUNT; ++i) {
        vec4 foam = u_wake_foam[i];
        WakeWay way = wake_way(i, p);
        float size = u_boat_form[i].x;
        float x = way.behind / size;
        float z = abs(way.aside) / size;
        float past = x - 0.86;
        float along = torn_variance(way.on_behind, size, fp);
        float across = torn_variance(way.on_aside, size, fp);
        // Noise lies on the water: places are counted from the centre of the course, which stands still.
        vec2 on = (p + u_boat_course[i].xy) / size;
        vec2 turned = vec2(0.8 * on.x - 0.6 * on.y, 0.6 * on.x + 0.8 * on.y);
        vec2 torn = torn_noise(TORN_NONE, 0.4, 0.31 * size, noise_value(NOISE_KEY, on / 0.31), fp);
        torn = torn_noise(torn, 0.35, 0.11 * size, noise_value(NOISE_KEY, turned / 0.11), fp);
        torn = torn_noise(torn, 0.25, 0.037 * size, noise_value(NOISE_KEY, on / 0.037), fp);
        float patches = torn_step(0.25, 0.72, torn.x, torn.y);
        float width = 0.085 + 0.055 * sqrt(max(past, 0.0));
        // Between both its rims, either of which a wide footprint sees.
        float band = torn_step(-1.15 * width, -0.5 * width, z, across) - torn_step(0.5 * width, 1.15 * width, z, across);
        band *= torn_step(-0.06, 0.04, past, along);
        float age = exp(-min(max(past, 0.0) * size / foam.y, 80.0));
        float run = min(x / 0.55, 1.0);
        float edge = 0.015 + 0.105 * run * (2.0 - run) + 0.16 * max(x - 0.55, 0.0);
        float reach = 0.02 + 0.025 * max(x, 0.0);
        float off = (z - edge) / reach;
        // A bell over a normal spread is a wider bell.
        float wider = 1.0 + 2.0 * across / (reach * reach);
        float thrown = torn_step(-0.01, 0.06, x, along) * exp(-min(off * off / wider + 1.3 * max(x, 0.0), 80.0)) * inversesqrt(wider);
        sum += foam.x * band * age * (0.3 + 0.9 * patches) + foam.z * thrown * (0.3 + patches)
            + wake_contact(i, p, foam.w, patches, fp);
    }
    return min(sum, WAKE_CAP);
}
