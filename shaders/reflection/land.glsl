// Land that a ray meets from anywhere over the water. docs/formulae.md, section 10.
const float AROUND_BLUR = 0.012; // ripples blur what is finer, rad

// First hit with land of a ray r (unit vector) from a place in the square (m from its middle) at a height.
bool land_along(vec2 q, float height, vec3 r, out float tau, out vec4 ground) {
    vec2 span = land_span(q, height, r);
    tau = span.x;
    ground = vec4(0.0);
    if (span.x >= span.y) {
        return false;
    }
    tau = land_free(q, height, r, 0.0, 0.0, tau, span.y);
    float fine = 0.02 * MARCH_TOLERANCE;
    float before;
    float gap;
    march_ground(q, height, r, span.y, fine, 0.1, true, tau, before, gap, ground);
    return tau < span.y && gap < fine * (0.1 + tau);
}

// Its light, before exposure, in the air.
vec3 land_seen(vec2 q, vec3 r, float tau, vec4 ground) {
    vec3 normal = normalize(vec3(-ground.y, 1.0, -ground.z));
    Footprint fp = Footprint(vec2(AROUND_BLUR * tau, 0.0), vec2(0.0, AROUND_BLUR * tau));
    Soil soil = land_soil(q + tau * r.xz, ground, fp, vec2(1.0, 0.6) * shore_wet(ground.x));
    vec3 place = vec3(q + tau * r.xz - shore_place(vec2(0.0)), ground.x).xzy;
    vec3 light = exposure() * land_light(r, normal, soil, sunlit(place, fp));
    return in_air(light, r, tau) / exposure();
}
