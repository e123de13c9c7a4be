// Bounds of the wakes as their map holds them: the window at its bow bends a wake far more sharply than its waves do, and counts
// where a ray passes near it.
uniform sampler2D u_wake_bounds; // a row a boat; height (m), slope, second derivative (1/m) from WAKE_AWAY of its lengths on

// ray: from the eye, not normalised; aside: how far from it rays of its tile are, m a unit; from: where it begins.
vec3 wakes_bounds(vec3 ray, float aside, float from) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < BOAT_COUNT; ++i) {
        vec2 place = boat_place(i);
        float nearest = max(dot(place, ray.xz) / max(dot(ray.xz, ray.xz), 1e-12), from);
        float away = (length(place - nearest * ray.xz) - nearest * aside) / u_boat_form[i].x;
        int kind = away < float(WAKE_AWAY[1]) ? 0 : away < float(WAKE_AWAY[2]) ? 1 : away < float(WAKE_AWAY[3]) ? 2 : 3;
        sum.xy += texel_at(u_wake_bounds, ivec2(0, i)).xy;
        sum.z += texel_at(u_wake_bounds, ivec2(kind, i)).z;
    }
    return sum;
}
