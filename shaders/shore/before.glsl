// Land that the ray meets before the water, at tau where it is wet.
bool find_land_before(vec3 ray, bool wet, float tau, out float land_tau, out vec4 ground) {
    return find_land(ray, wet ? tau : FARTHEST / max(length(ray.xz), 1e-6 * length(ray)), land_tau, ground);
}
