// Rays of a pinhole camera whose eye is the origin of (x, z); lengths in metres. docs/formulae.md, section 1.
uniform vec2 u_viewport;
uniform float u_eye_height;
uniform vec3 u_ray_x;
uniform vec3 u_ray_y;
uniform vec3 u_ray_z;

vec3 camera_ray(vec2 fragment) {
    vec2 clip = 2.0 * fragment / u_viewport - 1.0;
    return u_ray_z + clip.x * u_ray_x + clip.y * u_ray_y;
}

// Footprint of one sample on the plane through the hit with normal `normal`; held at grazing angles.
Footprint footprint(vec3 ray, float tau, vec3 normal) {
    vec3 step_x = u_ray_x * (2.0 / u_viewport.x);
    vec3 step_y = u_ray_y * (2.0 / u_viewport.y);
    float facing = min(dot(normal, ray), -1e-3 * length(normal) * length(ray));
    return Footprint(
        (tau * (step_x - ray * (dot(normal, step_x) / facing))).xz,
        (tau * (step_y - ray * (dot(normal, step_y) / facing))).xz);
}
