// Level water: where the ray meets y = 0, from above or below. ray: not normalised; returns tau < farthest, hit = eye + tau * ray.
const float FARTHEST = 1e5;

bool find_surface(vec3 ray, float farthest, out float tau, out vec3 wave) {
    wave = vec3(0.0);
    tau = 0.0;
    if (u_eye_height * ray.y >= 0.0) {
        return false;
    }
    tau = min(u_eye_height / -ray.y, FARTHEST / max(length(ray.xz), 1e-6 * length(ray)));
    return tau < farthest;
}
