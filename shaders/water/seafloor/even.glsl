// The sun's light on the floor where nothing focuses it, over that on a level surface.
vec3 bed_sunlight(vec2 at, Footprint fp) {
    return vec3(1.0);
}
