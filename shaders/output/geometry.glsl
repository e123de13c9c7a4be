// Normal (unit, over water that of its ripples too) and distance (m) of what the ray of a sample meets; 0 where it meets nothing.
out vec4 o_geometry;

void main() {
    vec3 ray = camera_ray(sample_place());
    float land_tau;
    vec4 ground;
    bool dry = find_land_ahead(ray, land_tau, ground);
    float farthest = dry ? land_tau : 1e30;
    float tau;
    vec3 wave;
    bool wet = find_surface(ray, farthest, tau, wave) && tau <= farthest;
    o_geometry = dry ? vec4(normalize(vec3(-ground.y, 1.0, -ground.z)), land_tau * length(ray)) : vec4(0.0);
    if (wet) {
        vec2 p = tau * ray.xz;
        Footprint fp = footprint(ray, tau, vec3(-wave.y, 1.0, -wave.z));
        vec2 slope = waves_shading(p, fp).yz + detail(p, fp).xy;
        o_geometry = vec4(normalize(vec3(-slope.x, 1.0, -slope.y)), tau * length(ray));
    }
}
