// No light, seen from under the surface: foam is white in the underside, all else black.
out vec4 o_color;

void main() {
    vec3 ray = camera_ray(sample_place());
    float tau;
    vec3 wave;
    o_color = vec4(0.0);
    if (find_underside(ray, tau, wave)) {
        vec2 p = tau * ray.xz;
        Footprint fp = footprint(ray, tau, vec3(wave.y, -1.0, wave.z));
        float amount = foam_amount(saturation(p, waves_shading(p, fp).x, fp), p, fp);
        o_color = vec4(min(foam_over(vec3(0.0), foam_light(vec3(0.0, 1.0, 0.0)), amount), BRIGHTEST), min(amount, 1.0));
    }
}
