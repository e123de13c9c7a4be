// What an eye under the surface sees: Snell's window and total reflection in the ceiling, the floor, and the water between,
// which absorbs and glows. docs/formulae.md, section 11. From over the surface: as ever.
uniform float u_below_level; // height of the surface in the mean, m

vec3 below_extinction() {
    return 1.0 / u_absorption_length + u_scattering;
}

// Light that the water itself sends along a way of `reach` metres that starts `depth` metres down, seen from its start; `fall`:
// how fast the way goes down. Light and sight fade alike: 1 + fall is 0 straight up, where it is held.
vec3 below_glow(float depth, float fall, float reach) {
    vec3 extinction = below_extinction();
    vec3 lit = 0.95 / PI * (u_sun_irradiance * max(u_sun_direction.y, 0.0) + u_sky_irradiance);
    vec3 deep = 0.4 * u_scattering / extinction * lit;
    float both = max(1.0 + fall, 1e-3);
    return 2.0 * deep * exp(-extinction * max(depth, 0.0)) * (1.0 - exp(-extinction * (both * reach))) / both;
}

// Light of floor and water along d (unit, falling) from a place p at height y; fp: footprint on the floor.
vec3 below_bed(vec2 p, float y, vec3 d, Footprint fp) {
    float reach = min(max(bed_depth() + y, 0.0) / max(-d.y, 1e-6), 1e6);
    vec3 bed = bed_light(p + reach * d.xz, bed_depth() + u_below_level, fp);
    return bed * exp(-below_extinction() * reach) + below_glow(u_below_level - y, -d.y, reach);
}

// Light that comes down along -d through the surface, or is mirrored in it. n: its normal, up; p, y: the place, `so_far` metres
// from the eye.
vec3 below_ceiling(vec3 d, vec3 n, float lost, vec2 p, float y, float so_far, Footprint fp) {
    float sigma2 = u_roughness * u_roughness + lost;
    float nv = max(dot(n, d), 0.0);
    float cv2 = min(nv * nv + sigma2 * (1.0 - nv * nv), 1.0);
    // Past the critical angle nothing comes through.
    float out2 = 1.0 - INDEX * INDEX * (1.0 - cv2);
    float out_c = sqrt(max(out2, 0.0));
    float reflectance = out2 > 0.0 ? fresnel(out_c) : 1.0;
    vec3 through = INDEX * d + (out_c - INDEX * nv) * n;
    through.y = sqrt(max(through.y, 0.0) * max(through.y, 0.0) + sigma2);
    through = normalize(through);
    // The sun through facets of variance sigma2/2 each way: a facet's tilt turns the ray by about a third of it.
    vec3 chord = through - u_sun_direction;
    float spread = 0.5 * (INDEX - 1.0) * (INDEX - 1.0) * sigma2;
    vec3 sun = u_sun_irradiance * min(exp(-min(dot(chord, chord) / (2.0 * spread), 80.0)) / (TAU * spread), 1e4);
    vec3 mirrored = reflect(d, n);
    mirrored.y = -sqrt(max(-mirrored.y, 0.0) * max(-mirrored.y, 0.0) + sigma2);
    mirrored = normalize(mirrored);
    // On its way on the footprint grows, and what it took out of the mirror blurs it.
    float way = (bed_depth() + y) / -mirrored.y;
    float wider = 1.0 + way / max(so_far, 1e-3);
    float blur = 2.0 * sqrt(lost) * way;
    fp = Footprint(wider * fp.x + vec2(blur, 0.0), wider * fp.y + vec2(0.0, blur));
    vec3 down = below_bed(p, y, mirrored, fp);
    return (1.0 - reflectance) * (sky_light(through) + sun) + reflectance * down;
}

void main() {
    if (u_eye_height >= waves(vec2(0.0)).x) {
        seen_from_above();
        return;
    }
    vec3 ray = camera_ray(gl_FragCoord.xy);
    vec3 d = normalize(ray);
    float depth = u_below_level - u_eye_height;
    float tau;
    vec3 wave;
    bool ceiling = find_ceiling(ray, tau, wave);
    float to_floor = max(bed_depth() + u_eye_height, 0.0) / max(-ray.y, 1e-6 * length(ray));
    if (!ceiling || (ray.y < 0.0 && to_floor < tau)) {
        Footprint fp = footprint(ray, min(to_floor, 1e6), vec3(0.0, 1.0, 0.0));
        vec3 light = exposure() * below_bed(vec2(0.0), u_eye_height, d, fp);
        o_color = vec4(min(light, BRIGHTEST), 0.0);
        return;
    }
    vec2 p = tau * ray.xz;
    Footprint fp = footprint(ray, tau, vec3(wave.y, -1.0, wave.z));
    vec4 shading = waves_shading(p, fp);
    vec3 ripple = detail(p, fp);
    float amount = foam_amount(saturation(p, shading.x, fp), p, fp);
    vec3 foam_normal = normalize(vec3(-shading.y - 0.5 * ripple.x, 1.0, -shading.z - 0.5 * ripple.y));
    vec3 normal = normalize(vec3(-shading.y - ripple.x, 1.0, -shading.z - ripple.y));
    float reach = tau * length(ray);
    vec3 water = exposure() * below_ceiling(d, normal, shading.w + ripple.z, p, shading.x, reach, fp);
    // Foam lets through half of what it sends up.
    vec3 light = foam_over(water, 0.5 * exposure() * foam_light(foam_normal), amount);
    light = light * exp(-below_extinction() * reach) + exposure() * below_glow(depth, -d.y, reach);
    o_color = vec4(min(light, BRIGHTEST), min(amount, 1.0));
}
