// Land that a ray meets from anywhere over the water. docs/formulae.md, section 10.
const float AROUND_BLUR = 0.012; // ripples blur what is finer, rad

// First hit with land of a ray r (unit vector) from a place in the square (m from its middle) at a height, inside the square and
// over y = 0: steps that cannot pass it. A ray that brushes a ridge would spend them all there: with the last half it goes on.
bool land_along(vec2 q, float height, vec3 r, out float tau, out vec4 ground) {
    vec2 way = vec2(abs(r.x) < 1e-9 ? 1e-9 : r.x, abs(r.z) < 1e-9 ? 1e-9 : r.z);
    vec2 one = (-0.5 * u_shore_size - q) / way;
    vec2 two = (0.5 * u_shore_size - q) / way;
    float leave = min(max(one.x, two.x), max(one.y, two.y));
    tau = max(max(min(one.x, two.x), min(one.y, two.y)), 0.0);
    ground = vec4(0.0);
    // A rising ray leaves through the top, a falling one at y = 0.
    if (r.y > 1e-6) {
        leave = min(leave, (u_shore_top - height) / r.y);
    } else if (r.y < -1e-6) {
        leave = min(leave, -height / r.y);
    }
    if (tau >= leave) {
        return false;
    }
    tau = land_free(q, height, r, 0.0, 0.0, tau, leave);
    float level = length(r.xz);
    float fastest = max(u_shore_steepest[0] * level - r.y, 1e-6);
    float fastest_dry = max(u_shore_steepest[1] * level - r.y, 1e-6);
    float gap = 0.0;
    float fine = 0.02 * MARCH_TOLERANCE;
    for (int i = 0; i < MARCH_STEPS; ++i) {
        ground = shore_floor(q + tau * r.xz);
        gap = height + tau * r.y - ground.x;
        if (gap < fine * (0.1 + tau) || tau >= leave) {
            break;
        }
        float before = tau;
        tau += max(gap / fastest, min(gap, height + tau * r.y) / fastest_dry);
        if (2 * i >= MARCH_STEPS) {
            tau = max(tau, before + (leave - before) / float(MARCH_STEPS - i));
        }
    }
    return tau < leave && gap < fine * (0.1 + tau);
}

// Its light, before exposure, in the air.
vec3 land_seen(vec2 q, vec3 r, float tau, vec4 ground) {
    vec3 normal = normalize(vec3(-ground.y, 1.0, -ground.z));
    Footprint fp = Footprint(vec2(AROUND_BLUR * tau, 0.0), vec2(0.0, AROUND_BLUR * tau));
    float grain = shore_grain(q + tau * r.xz, fp);
    vec3 light = exposure() * land_light(r, normal, ground_albedo(ground, grain), shore_wet(ground.x));
    return in_air(light, r, tau) / exposure();
}
