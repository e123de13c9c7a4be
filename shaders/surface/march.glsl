// First hit of the ray with the surface by steps that cannot pass it, then Newton. A ray that passes close over a crest goes on
// where the surface falls away from it, so that no back of a crest shows.
// ray: from the eye, 1 along the view; returns tau < farthest, hit = eye + tau * ray. Exact to float32 where steps suffice (1 degree under the horizon).
uniform float u_surface_top;

const float FARTHEST = 1e5;

bool find_surface(vec3 ray, float farthest, out float tau, out vec3 wave) {
    float speed = length(ray.xz);
    float reach = min(FARTHEST / max(speed, 1e-6 * length(ray)), farthest);
    float enter = 0.0;
    float leave = reach;
    float over = u_eye_height - u_surface_top;
    if (over > 0.0) {
        if (ray.y >= 0.0) {
            return false;
        }
        enter = over / -ray.y;
    } else if (ray.y > 0.0) {
        leave = min(leave, -over / ray.y);
    }
    if (ray.y < 0.0) {
        leave = max(u_eye_height - u_surface_trough, 0.0) / -ray.y;
    }
    leave = min(leave, reach);
    vec3 start = march_start(ray);
    enter = min(max(enter, start.r), leave);

    float fine = march_tolerance();
    vec3 now = surface_now();
    now.x -= surface_gentler(ray, enter);
    vec3 beyond = surface_beyond(ray, 0.0);
    tau = enter;
    march_open(ray, leave, fine, now, beyond.yz, start.b, tau);
    float gap = 0.0;
    // Looked at once before the loop: what the waves read from uniforms is then read there, not in every step.
    wave = waves(tau * ray.xz);
    for (int i = 0; i < MARCH_STEPS; ++i) {
        gap = u_eye_height + tau * ray.y - wave.x;
        float rate = ray.y - dot(wave.yz, ray.xz);
        if (tau >= leave || (gap < fine * tau && (gap < 0.0 || rate < 0.0))) {
            break;
        }
        tau += march_ahead(ray, tau, gap, rate, fine, now, tau < beyond.x ? vec2(0.0) : beyond.yz, start.b);
        wave = waves(tau * ray.xz);
    }
    if ((ray.y >= 0.0 || tau >= farthest) && gap >= fine * tau) {
        return false;
    }
    refine_water(vec2(0.0), u_eye_height, ray, 1.0, fine, enter, REFINE, true, tau, gap, wave);
    return true;
}
