// First hit with the surface of a ray from under it: steps that cannot pass it, then Newton. ray: not normalised; returns tau,
// hit = eye + tau * ray.

const float CEILING_FARTHEST = 1e5;

bool find_underside(vec3 ray, out float tau, out vec3 wave) {
    float size = length(ray);
    float leave = CEILING_FARTHEST / max(length(ray.xz), 1e-6 * size);
    wave = vec3(0.0);
    tau = max(u_surface_trough - u_eye_height, 0.0) / max(ray.y, 1e-6 * size);
    if (ray.y <= 0.0) {
        // Under a crest, and out of the slab that holds the waves at its bottom.
        leave = min(leave, max(u_eye_height - u_surface_trough, 0.0) / max(-ray.y, 1e-6 * size));
    }
    tau = max(tau, march_start(ray).r);
    if (tau >= leave) {
        return false;
    }
    float fine = march_tolerance();
    float fastest = max(surface_now().x * length(ray.xz) + ray.y, 1e-6 * size);
    float gap = 0.0;
    for (int i = 0; i < MARCH_STEPS; ++i) {
        wave = waves(tau * ray.xz);
        gap = wave.x - u_eye_height - tau * ray.y;
        if (tau >= leave || gap < fine * tau) {
            break;
        }
        tau += max(gap, 0.5 * fine * tau) / fastest;
    }
    if (ray.y <= 0.0 && gap >= fine * tau) {
        return false;
    }
    refine_water(vec2(0.0), u_eye_height, ray, -1.0, fine, 0.0, REFINE, false, tau, gap, wave);
    return true;
}
