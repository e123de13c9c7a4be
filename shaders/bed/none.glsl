// No floor: nothing comes from the end of an endless way down.
vec3 bed_light(vec2 at, float down, Footprint fp) {
    return vec3(0.0);
}
