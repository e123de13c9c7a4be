// The shore's floor where the ray refracted at the surface meets it. docs/formulae.md, section 8.

// Way of the refracted ray from the surface to the floor and of the light straight down to it, m; `at`: where it meets the
// floor. d, n: unit vectors. Steps of the fixed point that starts from the depth right under.
float floor_path(vec2 q, float height, vec3 d, vec3 n, out vec2 at) {
    vec3 r = refracted(d, n, -dot(n, d), INDEX);
    float fall = max(-r.y, 0.25);
    at = q;
    float under = max(height - shore_floor(q).x, 0.0);
    for (int i = 0; i < REFRACTION_STEPS; ++i) {
        at = q + r.xz * (under / fall);
        under = max(height - shore_floor(at).x, 0.0);
    }
    return under * (1.0 + 1.0 / fall);
}

void look_through(vec2 p, float height, vec3 d, vec3 normal, float unresolved, Footprint fp) {
    vec2 at;
    shore_path = floor_path(shore_place(p), height, d, normal, at);
    shore_albedo = floor_albedo(at, shore_floor(at), fp);
}
