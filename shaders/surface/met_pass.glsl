// What the ray of a sample meets first, water or land, so that no sample is asked for the light of both.
out vec4 o_met;

void main() {
    float tau;
    vec3 wave;
    vec4 ground;
    int met = first_met(camera_ray(sample_place()), tau, wave, ground);
    o_met = met == 0 ? vec4(0.0) : vec4(tau, float(met), 0.0, 0.0);
}
