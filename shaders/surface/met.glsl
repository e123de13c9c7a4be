// What rays meet, kept for the shading.

// @part first
// What a ray from the eye meets first, at ray * tau: WATER, with its height and gradient in `wave`, LAND over y = 0, with `ground`, or 0.
const int WATER = 1;
const int LAND = 2;

int first_met(vec3 ray, out float tau, out vec3 wave, out vec4 ground) {
    float land_tau;
    bool dry = find_land_ahead(ray, land_tau, ground);
    // Land first: no water is looked for under it.
    float farthest = dry ? land_tau : 1e30;
    bool wet = find_surface(ray, farthest, tau, wave) && tau <= farthest;
    tau = dry && !wet ? land_tau : tau;
    return wet ? WATER : dry ? LAND : 0;
}

// @part met
// The surface where an earlier pass has found it: 1 where the ray meets water, 2 where it meets land.
uniform sampler2D u_met; // tau, and which of them

bool find_surface(vec3 ray, float farthest, out float tau, out vec3 wave) {
    vec2 met = texel_at(u_met, as_int(floor(sample_place()))).rg;
    tau = met.r;
    wave = waves(tau * ray.xz);
    return met.g == 1.0;
}

// @part met_pass
// What the ray of a sample meets first, water or land, so that no sample is asked for the light of both.
out vec4 o_met;

void main() {
    float tau;
    vec3 wave;
    vec4 ground;
    int met = first_met(camera_ray(sample_place()), tau, wave, ground);
    o_met = met == 0 ? vec4(0.0) : vec4(tau, float(met), 0.0, 0.0);
}

// @part met_rising_pass
// What the ray of a sample meets that rises from over the water: land or nothing.
out vec4 o_met;

void main() {
    vec3 ray = camera_ray(sample_place());
    float tau;
    vec4 ground;
    o_met = find_land_ahead(ray, tau, ground) ? vec4(tau, 2.0, 0.0, 0.0) : vec4(0.0);
}
