// What the ray of a sample meets first, water or land, so that no sample is asked for the light of both.
out vec4 o_met;

void main() {
    vec3 ray = camera_ray(sample_place());
    float tau;
    vec3 wave;
    bool wet = find_surface(ray, 1e30, tau, wave);
    float land_tau;
    vec4 ground;
    bool dry = find_land_before(ray, wet, tau, land_tau, ground);
    o_met = dry ? vec4(land_tau, 2.0, 0.0, 0.0) : wet ? vec4(tau, 1.0, 0.0, 0.0) : vec4(0.0);
}
