// The floor under water is the plain ground.
vec3 floor_albedo(vec2 at, vec4 ground, Footprint fp) {
    return ground_albedo(ground, shore_grain(at, fp));
}
