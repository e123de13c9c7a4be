// The same toward land over y = 0, which is never steeper than u_shore_steepest[1].
vec4 land_start(vec3 ray, vec3 side, vec3 top) {
    vec2 eye = shore_place(vec2(0.0));
    float aside = length(side.xz) + length(top.xz);
    float raised = abs(side.y) + abs(top.y);
    float speed = length(ray.xz) + aside;
    float toward = raised - ray.y;
    float reach = 1e5 / max(speed, 1e-6 * length(ray));
    float over = u_eye_height - u_shore_top;
    float tau = over > 0.0 ? (toward > 0.0 ? over / toward : reach) : 0.0;
    float fastest = max(u_shore_steepest[1] * speed + toward, 1e-6 * length(ray));
    for (int i = 0; i < MARCH_STEPS; ++i) {
        if (tau >= reach) {
            break;
        }
        float gap = u_eye_height + tau * ray.y - max(shore_floor(eye + tau * ray.xz).x, 0.0);
        float longest = (gap - tau * (raised + u_shore_steepest[1] * aside)) / fastest;
        tau += max(longest, 0.0);
        if (longest < START_SHARE * tau * raised) {
            break;
        }
    }
    return vec4(0.0, min(tau, reach), 0.0, 0.0);
}
