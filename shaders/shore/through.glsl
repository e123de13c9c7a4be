// The shore's floor where the ray through the surface meets it.
void look_through(vec2 p, float height, vec3 d, vec3 normal, float lost, Footprint fp) {
    vec2 at;
    shore_path = floor_path(shore_place(p), height, d, normal, at);
    shore_albedo = ground_albedo(shore_floor(at), shore_grain(at, fp));
}
