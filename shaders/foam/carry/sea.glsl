// Where the water at p rests, from maps of the tiles that raise the sea.
uniform sampler2D u_sea_orbits; // x, z: to the resting place, m

vec2 sea_carry(vec2 p) {
    return sea_fetch_four(u_sea_orbits, sea_place_0(p), 0).xy + sea_fetch_four(u_sea_orbits, sea_place_1(p), 1).xy;
}
