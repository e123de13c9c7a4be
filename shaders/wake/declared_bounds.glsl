// Bounds that boats alone state of their wakes: the window at its bow bends a wake far more sharply than its waves do, and counts where a ray passes near it.
uniform float u_wake_highest; // m
uniform vec3 u_wake_bounds[BOAT_COUNT]; // slope; second derivative near the bow, and elsewhere (1/m)

// ray: from the eye, not normalised; aside: how far from it rays of its tile are, m a unit; from: where it begins.
vec3 wakes_bounds(vec3 ray, float aside, float from) {
    vec3 sum = vec3(u_wake_highest, 0.0, 0.0);
    for (int i = 0; i < BOAT_COUNT; ++i) {
        vec2 place = boat_place(i);
        float nearest = max(dot(place, ray.xz) / max(dot(ray.xz, ray.xz), 1e-12), from);
        float away = length(place - nearest * ray.xz) - nearest * aside;
        sum.yz += vec2(u_wake_bounds[i].x, away < WAKE_NEAR * u_boat_form[i].x ? u_wake_bounds[i].y : u_wake_bounds[i].z);
    }
    return sum;
}
