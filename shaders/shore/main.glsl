// A sample of sea or land, whichever the ray meets first. Linear light, A = foam amount.
out vec4 o_color;

void main() {
    vec3 ray = camera_ray(gl_FragCoord.xy);
    float tau;
    vec3 wave;
    bool wet = find_surface(ray, tau, wave);
    float land_tau;
    vec4 ground;
    vec3 d = normalize(ray);
    if (find_land(ray, wet ? tau : FARTHEST / max(length(ray.xz), 1e-6 * length(ray)), land_tau, ground)) {
        vec3 normal = normalize(vec3(-ground.y, 1.0, -ground.z));
        Footprint fp = footprint(ray, land_tau, normal);
        float grain = shore_grain(shore_place(land_tau * ray.xz), fp);
        vec3 light = exposure() * land_light(d, normal, ground_albedo(ground, grain), shore_wet(ground.x));
        o_color = vec4(min(in_air(light, d, land_tau * length(ray)), BRIGHTEST), 0.0);
        return;
    }
    if (!wet) {
        discard;
    }
    vec2 p = tau * ray.xz;
    Footprint fp = footprint(ray, tau, vec3(-wave.y, 1.0, -wave.z));
    vec4 shading = waves_shading(p, fp);
    vec3 ripple = detail(p, fp);

    float f = saturation(p, shading.x, fp);
    float amount = foam_amount(f, p, fp);

    vec3 foam_normal = normalize(vec3(-shading.y - 0.5 * ripple.x, 1.0, -shading.z - 0.5 * ripple.y));
    vec3 normal = normalize(vec3(-shading.y - ripple.x, 1.0, -shading.z - ripple.y));
    vec2 at;
    shore_path = floor_path(shore_place(p), shading.x, d, normal, at);
    shore_albedo = ground_albedo(shore_floor(at), shore_grain(at, fp));
    vec3 water = exposure() * water_light(d, normal, shading.w + ripple.z, shading.x);
    vec3 foam = exposure() * foam_light(foam_normal);
    vec3 light = in_air(foam_over(water, foam, amount), d, tau * length(ray));
    o_color = vec4(min(light, BRIGHTEST), min(amount, 1.0));
}
