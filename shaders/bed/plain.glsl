// A bare floor.
uniform vec3 u_floor_albedo;

vec3 bed_albedo(vec2 at, Footprint fp) {
    return u_floor_albedo;
}
