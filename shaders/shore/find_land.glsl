// First hit of the ray with land, above y = 0 and inside the square, before `farthest`.
bool find_land(vec3 ray, float farthest, out float tau, out vec4 ground) {
    vec2 eye = shore_place(vec2(0.0));
    vec2 span = land_span(eye, u_eye_height, ray);
    float enter = max(span.x, march_start(ray).g);
    float leave = min(span.y, farthest);
    if (enter < leave) {
        enter = land_free(eye, u_eye_height, ray, 0.0, 0.0, enter, leave);
    }
    tau = enter;
    ground = vec4(0.0);
    if (enter >= leave) {
        return false;
    }
    float fine = march_tolerance();
    float before;
    float gap;
    march_ground(eye, u_eye_height, ray, leave, fine, 0.0, true, tau, before, gap, ground);
    bool passed = tau < leave && gap < -fine * tau;
    // Counted, so that drivers without branches do not go through all of them in vain.
    int rounds = passed ? 8 : 0;
    for (int i = 0; i < rounds; ++i) {
        float middle = 0.5 * (before + tau);
        if (u_eye_height + middle * ray.y < shore_floor(eye + middle * ray.xz).x) {
            tau = middle;
        } else {
            before = middle;
        }
    }
    if (passed) {
        ground = shore_floor(eye + tau * ray.xz);
        gap = u_eye_height + tau * ray.y - ground.x;
    }
    if (tau >= leave || gap >= fine * tau) {
        return false;
    }
    refine_ground(eye, u_eye_height, ray, 1.0, fine, enter, REFINE, false, tau, gap, ground);
    return true;
}
