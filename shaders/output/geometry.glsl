// Normal (unit, over water that of its ripples too) and distance (m) of what the ray of a sample meets; 0 where it meets nothing.
out vec4 o_geometry;

void main() {
    vec3 ray = camera_ray(sample_place());
    float tau;
    vec3 wave;
    vec4 ground;
    int met = first_met(ray, tau, wave, ground);
    vec2 slope = ground.yz;
    if (met == WATER) {
        vec2 p = tau * ray.xz;
        Footprint fp = footprint(ray, tau, vec3(-wave.y, 1.0, -wave.z));
        slope = waves_shading(p, fp).yz + detail(p, fp).xy;
    }
    o_geometry = met == 0 ? vec4(0.0) : vec4(normalize(vec3(-slope.x, 1.0, -slope.y)), tau * length(ray));
}
