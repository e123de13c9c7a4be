// No floor: an endless way down, and nothing at its end.
float bed_depth() {
    return 1e6;
}

vec3 bed_light(vec2 at, float down, Footprint fp) {
    return vec3(0.0);
}
