// A sample of the sea over a level floor: find the surface, follow the refracted ray to the floor, shade water, lay foam on it,
// put air before it. Linear light, A = foam amount.
out vec4 o_color;

void main() {
    vec3 ray = camera_ray(gl_FragCoord.xy);
    float tau;
    vec3 wave;
    if (!find_surface(ray, tau, wave)) {
        discard;
    }
    vec2 p = tau * ray.xz;
    Footprint fp = footprint(ray, tau, vec3(-wave.y, 1.0, -wave.z));
    vec4 shading = waves_shading(p, fp);
    vec3 ripple = detail(p, fp);

    float f = saturation(p, shading.x, fp);
    float amount = foam_amount(f, p, fp);

    vec3 d = normalize(ray);
    vec3 foam_normal = normalize(vec3(-shading.y - 0.5 * ripple.x, 1.0, -shading.z - 0.5 * ripple.y));
    vec3 normal = normalize(vec3(-shading.y - ripple.x, 1.0, -shading.z - ripple.y));
    // The ray refracted at the surface; ripples that face away are taken edge-on, and none may tilt the ray level.
    float c = max(-dot(normal, d), 0.0);
    vec3 down = d / INDEX + (c / INDEX - sqrt(1.0 - (1.0 - c * c) / (INDEX * INDEX))) * normal;
    bed_down = bed_depth() + shading.x;
    bed_way = bed_down / max(-down.y, 0.25);
    // What the footprint took out of the surface bends the ray by a third of its slope.
    float blur = 0.34 * sqrt(shading.w + ripple.z) * bed_way;
    Footprint seen = Footprint(fp.x + vec2(blur, 0.0), fp.y + vec2(0.0, blur));
    bed_seen = bed_light(p + bed_way * down.xz, bed_down, seen);
    vec3 water = exposure() * water_light(d, normal, shading.w + ripple.z, shading.x);
    vec3 foam = exposure() * foam_light(foam_normal);
    vec3 light = in_air(foam_over(water, foam, amount), d, tau * length(ray));
    o_color = vec4(min(light, BRIGHTEST), min(amount, 1.0));
}
