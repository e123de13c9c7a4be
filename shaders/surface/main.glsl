// A sample of the sea: find the surface, shade water, lay foam on it, put air before it; land where it stands before the sea.
// Linear light, A = foam amount.
out vec4 o_color;

void main() {
    vec3 ray = camera_ray(sample_place());
    vec3 d = normalize(ray);
    float tau;
    vec3 wave;
    vec4 ground;
    int met = first_met(ray, tau, wave, ground);
    if (met == LAND) {
        o_color = land_color(ray, d, tau, ground);
        return;
    }
    if (met != WATER) {
        discard;
    }
    vec2 p = tau * ray.xz;
    Footprint fp = footprint(ray, tau, vec3(-wave.y, 1.0, -wave.z));
    vec4 shading = waves_shading(p, fp);
    vec3 ripple = detail(p, fp);

    float f = saturation(p, shading.x, fp);
    float amount = 0.0;
    if (f > 0.0) {
        amount = foam_amount(f, p, fp);
        foam_relief(f, amount, p, fp);
    }
    vec3 place = vec3(p.x, u_eye_height + tau * ray.y, p.y);
    shade_sun(place, fp);

    vec3 foam_normal = normalize(vec3(-shading.y - 0.5 * ripple.x, 1.0, -shading.z - 0.5 * ripple.y));
    vec3 normal = normalize(vec3(-shading.y - ripple.x, 1.0, -shading.z - ripple.y));
    look_through(p, shading.x, d, normal, shading.w + ripple.z, fp);
    vec3 water = exposure() * water_light(place, d, normal, vec2(shading.w, ripple.z), shading.x, f);
    vec4 layer = foam_layer(foam_normal, d, f);
    // What an opaque layer shows of the water is none.
    vec3 foam = exposure() * layer.rgb + (1.0 - layer.a) * water;
    vec3 light = in_air(foam_over(water, foam, amount), d, tau * length(ray));
    o_color = vec4(min(light, BRIGHTEST), min(amount, 1.0));
}
