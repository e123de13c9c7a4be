// Land over y = 0 that the ray meets, as if there were no water.
bool find_land_ahead(vec3 ray, out float land_tau, out vec4 ground) {
    return find_land(ray, FARTHEST / max(length(ray.xz), 1e-6 * length(ray)), land_tau, ground);
}
