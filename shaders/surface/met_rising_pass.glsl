// What the ray of a sample meets that rises from over the water: land or nothing.
out vec4 o_met;

void main() {
    vec3 ray = camera_ray(sample_place());
    float tau;
    vec4 ground;
    o_met = find_land_ahead(ray, tau, ground) ? vec4(tau, 2.0, 0.0, 0.0) : vec4(0.0);
}
