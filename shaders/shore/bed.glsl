// The shore's floor as an eye under water sees it.
vec3 bed_albedo(vec2 at, Footprint fp) {
    vec2 q = shore_place(at);
    return ground_albedo(shore_floor(q), shore_grain(q, fp));
}
