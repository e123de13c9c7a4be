// First hit of the ray with land, above y = 0 and inside the square, before `farthest`: steps that cannot pass it.
bool find_land(vec3 ray, float farthest, out float tau, out vec4 ground) {
    vec2 eye = shore_place(vec2(0.0));
    vec2 way = vec2(abs(ray.x) < 1e-9 ? 1e-9 : ray.x, abs(ray.z) < 1e-9 ? 1e-9 : ray.z);
    vec2 one = (-0.5 * u_shore_size - eye) / way;
    vec2 two = (0.5 * u_shore_size - eye) / way;
    float enter = max(max(min(one.x, two.x), min(one.y, two.y)), 0.0);
    float leave = min(min(max(one.x, two.x), max(one.y, two.y)), farthest);
    float over = u_eye_height - u_shore_top;
    float fall = abs(ray.y) < 1e-9 ? -1e-9 : ray.y;
    // A rising ray leaves through the top, a falling one enters there and leaves at y = 0, where the sea begins.
    if (over > 0.0) {
        enter = max(enter, ray.y < 0.0 ? over / -fall : 1e30);
    } else if (ray.y > 0.0) {
        leave = min(leave, -over / fall);
    }
    if (ray.y < 0.0) {
        leave = min(leave, u_eye_height / -fall);
    }
    enter = max(enter, march_start(ray).g);
    if (enter < leave) {
        enter = land_free(eye, u_eye_height, ray, 0.0, 0.0, enter, leave);
    }
    tau = enter;
    ground = vec4(0.0);
    if (enter >= leave) {
        return false;
    }
    float fine = MARCH_TOLERANCE * length(u_ray_y) * 2.0 / u_viewport.y;
    float level = length(ray.xz);
    float fastest = max(u_shore_steepest[0] * level - ray.y, 1e-6 * length(ray));
    float fastest_dry = max(u_shore_steepest[1] * level - ray.y, 1e-6 * length(ray));
    float gap = 0.0;
    float before = tau;
    for (int i = 0; i < MARCH_STEPS; ++i) {
        ground = shore_floor(eye + tau * ray.xz);
        gap = u_eye_height + tau * ray.y - ground.x;
        if (gap < fine * tau || tau >= leave) {
            break;
        }
        before = tau;
        // Land over y = 0 is gentler than the floor, and lower than the eye's way by no more than that way's own height.
        tau += max(gap / fastest, min(gap, u_eye_height + tau * ray.y) / fastest_dry);
        // A ray that brushes a ridge would spend all its steps there: with the last half it goes on to the end.
        if (2 * i >= MARCH_STEPS) {
            tau = max(tau, before + (leave - before) / float(MARCH_STEPS - i));
        }
    }
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
    float limit = 4.0 * max(fine * tau, abs(gap)) / (1e-3 * length(ray));
    for (int i = 0; i < REFINE; ++i) {
        float rate = ray.y - dot(ground.yz, ray.xz);
        if (rate < -1e-3 * length(ray)) {
            tau = max(tau - clamp(gap / rate, -limit, limit), enter);
            ground = shore_floor(eye + tau * ray.xz);
            gap = u_eye_height + tau * ray.y - ground.x;
        }
    }
    return true;
}
