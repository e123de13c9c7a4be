// A sample of the water: what it is, and how it is lit. One program does both, or two, one after the other.

// @part sample
// What lights a sample of the water.
struct Sample {
    vec4 shading;  // height, gradient, and mean square slope of waves that the footprint does not resolve
    vec3 ripple;   // gradient and mean square slope of ripples, the same way
    vec2 slope;    // gradient where the ray meets the surface, of all waves
    float f;       // foam's saturation and amount
    float amount;
};

// @part sampled
// The sample where a ray meets the water, at ray * tau. normal: of the surface there, not normalised, toward the eye.
Sample sample_of(vec3 ray, float tau, vec3 normal, vec2 slope) {
    vec2 p = tau * ray.xz;
    Footprint fp = footprint(ray, tau, normal);
    Sample s = Sample(waves_shading(p, fp), detail(p, fp), slope, 0.0, 0.0);
    s.f = saturation(p, s.shading.x, fp);
    s.amount = s.f > 0.0 ? foam_amount(s.f, p, fp) : 0.0;
    return s;
}

// @part found
// What a ray meets first, from over the water, at ray * tau: WATER, with its sample, LAND or 0.
int first_sample(vec3 ray, out float tau, out vec4 ground, out Sample s) {
    vec3 wave;
    int met = first_met(ray, tau, wave, ground);
    if (met == WATER) {
        s = sample_of(ray, tau, vec3(-wave.y, 1.0, -wave.z), wave.yz);
    }
    return met;
}

// @part found_below
// What a ray meets first, from under the water, at ray * tau: WATER, with its sample, or 0.
const int WATER = 1;

int first_sample(vec3 ray, out float tau, out vec4 ground, out Sample s) {
    vec3 wave;
    ground = vec4(0.0);
    if (!find_underside(ray, tau, wave)) {
        return 0;
    }
    s = sample_of(ray, tau, vec3(wave.y, -1.0, wave.z), wave.yz);
    return WATER;
}

// @part samples_pass
// Samples of the water, kept for the pass that lights them: neither program is as large as one for both.
layout(location = 0) out vec4 o_shading;
layout(location = 1) out vec4 o_place; // tau, 0 where there is no water
layout(location = 2) out vec4 o_foam;

void main() {
    vec3 ray = camera_ray(sample_place());
    float tau;
    vec4 ground;
    Sample s;
    o_shading = o_place = o_foam = vec4(0.0);
    if (first_sample(ray, tau, ground, s) == WATER) {
        o_shading = s.shading;
        o_place = vec4(tau, s.ripple);
        o_foam = vec4(s.slope, s.f, s.amount);
    }
}

// @part kept
// The sample that an earlier pass has kept.
const int WATER = 1;
const int LAND = 2;
uniform sampler2DArray u_surface_samples;

int first_sample(vec3 ray, out float tau, out vec4 ground, out Sample s) {
    ivec2 at = as_int(floor(gl_FragCoord.xy));
    vec4 place = texel_at(u_surface_samples, ivec3(at, 1));
    vec4 foam = texel_at(u_surface_samples, ivec3(at, 2));
    tau = place.x;
    ground = vec4(0.0);
    s = Sample(texel_at(u_surface_samples, ivec3(at, 0)), place.yzw, foam.xy, foam.z, foam.w);
    return tau > 0.0 ? WATER : 0;
}

// @part main
// A sample of the sea: find the surface, shade water, lay foam on it, put air before it; land where it stands before the sea.
// Linear light, A = foam amount.
out vec4 o_color;

void main() {
    vec3 ray = camera_ray(sample_place());
    vec3 d = normalize(ray);
    float tau;
    vec4 ground;
    Sample s;
    int met = first_sample(ray, tau, ground, s);
    if (met == LAND) {
        o_color = land_color(ray, d, tau, ground);
        return;
    }
    if (met != WATER) {
        discard;
    }
    vec2 p = tau * ray.xz;
    Footprint fp = footprint(ray, tau, vec3(-s.slope.x, 1.0, -s.slope.y));
    if (s.f > 0.0) {
        foam_relief(s.f, s.amount, p, fp);
    }
    vec3 place = vec3(p.x, u_eye_height + tau * ray.y, p.y);
    shade_sun(place, fp);

    vec2 slope = s.shading.yz;
    vec3 foam_normal = normalize(vec3(-slope.x - 0.5 * s.ripple.x, 1.0, -slope.y - 0.5 * s.ripple.y));
    vec3 normal = normalize(vec3(-slope.x - s.ripple.x, 1.0, -slope.y - s.ripple.y));
    look_through(p, s.shading.x, d, normal, s.shading.w + s.ripple.z, fp);
    vec3 water = exposure() * water_light(place, d, normal, vec2(s.shading.w, s.ripple.z), s.shading.x, s.f);
    vec4 layer = foam_layer(foam_normal, d, s.f);
    // What an opaque layer shows of the water is none.
    vec3 foam = exposure() * layer.rgb + (1.0 - layer.a) * water;
    vec3 light = in_air(foam_over(water, foam, s.amount), d, tau * length(ray));
    o_color = vec4(min(light, BRIGHTEST), min(s.amount, 1.0));
}
