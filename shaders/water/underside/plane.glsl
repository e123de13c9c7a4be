// Level water from under it: where the ray meets y = 0. ray: not normalised; returns tau, hit = eye + tau * ray.
bool find_underside(vec3 ray, out float tau, out vec3 wave) {
    wave = vec3(0.0);
    tau = min(-u_eye_height / max(ray.y, 1e-6 * length(ray)), 1e5 / max(length(ray.xz), 1e-6 * length(ray)));
    return ray.y > 0.0;
}
