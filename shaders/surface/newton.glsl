// The mesh has found the surface; Newton steps along the ray finish. ray: not normalised; returns tau < farthest, hit = eye + tau * ray.
in vec3 v_position;

bool find_surface(vec3 ray, float farthest, out float tau, out vec3 wave) {
    vec3 to_mesh = v_position - vec3(0.0, u_eye_height, 0.0);
    tau = dot(to_mesh, ray) / dot(ray, ray);
    float limit = 0.05 * tau;
    // Waves too small to be told apart from here have no crest to hide behind: the same filter as the shading's.
    Footprint level = footprint(ray, tau, vec3(0.0, 1.0, 0.0));
    wave = waves_shading(tau * ray.xz, level).xyz;
    for (int i = 0; i < REFINE; ++i) {
        float gap = u_eye_height + tau * ray.y - wave.x;
        float rate = ray.y - dot(wave.yz, ray.xz);
        // Rising along the ray or parallel to it: no root to be found downhill.
        if (rate < -1e-3 * length(ray)) {
            tau -= clamp(gap / rate, -limit, limit);
            wave = waves_shading(tau * ray.xz, level).xyz;
        }
    }
    return tau > 0.0 && tau < farthest;
}
