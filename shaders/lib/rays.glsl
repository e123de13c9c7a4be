// The camera's rays, places along them, and Newton's method to a height field.

// @part camera
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
    vec3 step_x = u_ray_x * (2.0 * FOOTPRINT_X / u_viewport.x);
    vec3 step_y = u_ray_y * (2.0 / u_viewport.y);
    float facing = min(dot(normal, ray), -1e-3 * length(normal) * length(ray));
    return Footprint(
        (tau * (step_x - ray * (dot(normal, step_x) / facing))).xz,
        (tau * (step_y - ray * (dot(normal, step_y) / facing))).xz);
}

// @part place
// Where this sample lies in the picture, in samples of the picture's grid. docs/formulae.md, section 1.
vec2 sample_place() {
    return gl_FragCoord.xy;
}

// @part place_shifted
// The same where the rows of drawn pixels are shifted against one another, by half of their width.
vec2 sample_place() {
    return gl_FragCoord.xy + vec2(fract(0.5 * gl_FragCoord.y) < 0.5 ? -ROW_SHIFT : ROW_SHIFT, 0.0);
}

// @part newton
// Newton's method along a ray to a height field, from where a march has come close to it. docs/formulae.md, section 3.
// The planner puts the name of the function that gives the field's height and gradient in the place of field_at, and its type.
// Ray: q + tau ray.xz, height + tau ray.y. sense: 1 over the field, -1 under it; fine: the march's tolerance over tau; least: of tau.
// gap: from the ray to the field, on the ray's side; met: the field under it.
// crests: a step over a crest is not taken. It would end on the crest's back, and the place before it is within the march's tolerance.
void refine(
    vec2 q, float height, vec3 ray, float sense, float fine, float least, int rounds, bool crests,
    inout float tau, inout float gap, inout vec4 met) {
    float slowest = 1e-3 * length(ray);
    float limit = 4.0 * max(fine * tau, abs(gap)) / slowest;
    for (int i = 0; i < rounds; ++i) {
        float rate = sense * (ray.y - dot(met.yz, ray.xz));
        if (rate < -slowest) {
            float trial = max(tau - clamp(gap / rate, -limit, limit), least);
            vec4 there = field_at(q + trial * ray.xz);
            if (!crests || sense * (ray.y - dot(there.yz, ray.xz)) < 0.0) {
                tau = trial;
                met = there;
                gap = sense * (height + tau * ray.y - met.x);
            }
        }
    }
}
