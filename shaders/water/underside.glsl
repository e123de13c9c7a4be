// The surface from below.

// @part find
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

// @part plane
// Level water from under it: where the ray meets y = 0. ray: not normalised; returns tau, hit = eye + tau * ray.
bool find_underside(vec3 ray, out float tau, out vec3 wave) {
    wave = vec3(0.0);
    tau = min(-u_eye_height / max(ray.y, 1e-6 * length(ray)), 1e5 / max(length(ray.xz), 1e-6 * length(ray)));
    return ray.y > 0.0;
}

// @part flat
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

// @part water
// The water between an eye under the surface and what it sees: it absorbs and glows. docs/formulae.md, section 11.

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

// @part main
// What an eye under the surface sees: Snell's window and total reflection at the underside, and the floor. docs/formulae.md,
// section 11. Linear light, A = foam amount.
out vec4 o_color;

// Light of floor and water along d (unit) from a place p at height y, where the floor is `reach` metres away; fp: footprint there.
vec3 below_bed(vec2 p, float y, vec3 d, float reach, Footprint fp) {
    vec3 bed = bed_light(p + reach * d.xz, max(-y - reach * d.y, 0.0), fp);
    return bed * exp(-below_extinction() * reach) + below_glow(-y, -d.y, reach);
}

// Light that comes down along -d through the surface, or is mirrored in it. n: its normal, up; mirrored: the light that it mirrors.
vec3 below_underside(vec3 d, vec3 n, float unresolved, vec3 mirrored) {
    float sigma2 = u_roughness * u_roughness + unresolved;
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
    return (1.0 - reflectance) * (sky_light(through) + sun) + reflectance * mirrored;
}

// d (unit) mirrored downward in a surface with normal n.
vec3 below_mirrored(vec3 d, vec3 n, float unresolved) {
    vec3 mirrored = reflect(d, n);
    float down = max(-mirrored.y, 0.0);
    mirrored.y = -sqrt(down * down + u_roughness * u_roughness + unresolved);
    return normalize(mirrored);
}

void main() {
    vec3 ray = camera_ray(sample_place());
    vec3 d = normalize(ray);
    float tau;
    vec4 ground;
    Sample s;
    bool wet = first_sample(ray, tau, ground, s) == WATER;
    float reach = tau * length(ray);
    // The floor that is seen: straight from the eye, or from the underside, mirrored.
    vec2 p = vec2(0.0);
    float y = u_eye_height;
    vec3 toward = d;
    float way = bed_reach(p, y, d);
    Footprint fp = footprint(ray, way / length(ray), vec3(0.0, 1.0, 0.0));
    bool underside = wet && way >= reach;
    float unresolved = 0.0;
    vec3 normal = vec3(0.0, 1.0, 0.0);
    if (underside) {
        p = tau * ray.xz;
        y = s.shading.x;
        normal = normalize(vec3(-s.shading.y - s.ripple.x, 1.0, -s.shading.z - s.ripple.y));
        unresolved = s.shading.w + s.ripple.z;
        toward = below_mirrored(d, normal, unresolved);
        way = bed_reach(p, y, toward);
        // On its way on the footprint grows, and what it took out of the mirror blurs it.
        fp = footprint(ray, tau, vec3(s.slope.x, -1.0, s.slope.y));
        float wider = 1.0 + way / max(reach, 1e-3);
        float blur = 2.0 * sqrt(unresolved) * way;
        fp = Footprint(wider * fp.x + vec2(blur, 0.0), wider * fp.y + vec2(0.0, blur));
    }
    vec3 bed = below_bed(p, y, toward, way, fp);
    if (!underside) {
        o_color = vec4(min(exposure() * bed, BRIGHTEST), 0.0);
        return;
    }
    vec3 foam_normal = normalize(vec3(-s.shading.y - 0.5 * s.ripple.x, 1.0, -s.shading.z - 0.5 * s.ripple.y));
    vec3 water = exposure() * below_underside(d, normal, unresolved, bed);
    // Foam lets through half of what it sends up.
    vec3 light = foam_over(water, 0.5 * exposure() * foam_light(foam_normal), s.amount);
    light = light * exp(-below_extinction() * reach) + exposure() * below_glow(-u_eye_height, -d.y, reach);
    o_color = vec4(min(light, BRIGHTEST), min(s.amount, 1.0));
}
