// Land that the ray meets before the water, at tau where it is wet.
bool find_land_before(vec3 ray, vec3 d, bool wet, float tau, out vec4 color) {
    color = vec4(0.0);
    float land_tau;
    vec4 ground;
    if (!find_land(ray, wet ? tau : FARTHEST / max(length(ray.xz), 1e-6 * length(ray)), land_tau, ground)) {
        return false;
    }
    vec3 normal = normalize(vec3(-ground.y, 1.0, -ground.z));
    Footprint fp = footprint(ray, land_tau, normal);
    float grain = shore_grain(shore_place(land_tau * ray.xz), fp);
    vec3 light = exposure() * land_light(d, normal, ground_albedo(ground, grain), shore_wet(ground.x));
    color = vec4(min(in_air(light, d, land_tau * length(ray)), BRIGHTEST), 0.0);
    return true;
}
