// The same toward land over y = 0, which is never steeper than u_shore_steepest[1].
vec3 land_start(vec3 ray, vec3 side, vec3 top) {
    vec2 eye = shore_place(vec2(0.0));
    Pyramid rays = pyramid(ray, side, top);
    float toward = rays.raised - ray.y;
    float over = u_eye_height - u_shore_top;
    float tau = pyramid_enters(rays, over, toward);
    float fastest = max(u_shore_steepest[1] * rays.speed + toward, 1e-6 * length(ray));
    for (int i = 0; i < MARCH_STEPS; ++i) {
        if (tau >= rays.reach) {
            break;
        }
        float gap = u_eye_height + tau * ray.y - max(shore_floor(eye + tau * ray.xz).x, 0.0);
        float longest = (gap - tau * (rays.raised + u_shore_steepest[1] * rays.aside)) / fastest;
        tau += max(longest, 0.0);
        if (longest < START_SHARE * tau * rays.raised) {
            break;
        }
    }
    return vec3(0.0, min(tau, rays.reach), 0.0);
}
