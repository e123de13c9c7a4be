// A march over the open sea to the square of the shore, where the shore's waves need not be looked at. It ends at the square, at `leave`, or
// where the surface is met.
void march_open(vec3 ray, float leave, float fine, vec3 now, vec2 less, float bend, inout float tau) {
    vec2 span = shore_span(shore_place(vec2(0.0)), ray.xz);
    float outside = min(span.x < span.y ? span.x : 1e30, leave);
    for (int i = 0; i < MARCH_STEPS; ++i) {
        if (tau >= outside) {
            break;
        }
        vec3 wave = open_waves(tau * ray.xz);
        float gap = u_eye_height + tau * ray.y - wave.x;
        float rate = ray.y - dot(wave.yz, ray.xz);
        if (gap < fine * tau && (gap < 0.0 || rate < 0.0)) {
            break;
        }
        tau = min(tau + march_ahead(ray, tau, gap, rate, fine, now, less, bend), outside);
    }
}
