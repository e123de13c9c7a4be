// What the ray of a sample meets first, water or land, so that no sample is asked for the light of both.
out vec4 o_met;

void main() {
    vec3 ray = camera_ray(sample_place());
    float land_tau;
    vec4 ground;
    bool dry = find_land_ahead(ray, land_tau, ground);
    // Land first: no water is looked for under it.
    float farthest = dry ? land_tau : 1e30;
    float tau;
    vec3 wave;
    bool wet = find_surface(ray, farthest, tau, wave) && tau <= farthest;
    o_met = wet ? vec4(tau, 1.0, 0.0, 0.0) : dry ? vec4(land_tau, 2.0, 0.0, 0.0) : vec4(0.0);
}
