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
