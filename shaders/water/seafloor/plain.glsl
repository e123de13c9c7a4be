// A bare floor.
vec3 bed_albedo(vec2 at, Footprint fp) {
    return u_floor_albedo;
}
