// A swell whose crests are lines of equal travel time: phase (periods); how much of its height islands leave, and 1.
uniform sampler2D u_shore_travel; // arrival (periods), share of the height

vec3 shore_arrival(ivec2 here, float d, vec2 g) {
    vec2 travel = texel_at(u_shore_travel, here).rg;
    return vec3(-travel.r, travel.g, 1.0);
}
