// Where the water at p rests, from maps of the tiles that raise the sea.
uniform sampler2D u_sea_orbit_0; // x, z: to the resting place, m
uniform sampler2D u_sea_orbit_1;

vec2 sea_carry(vec2 p) {
    return sea_fetch(u_sea_orbit_0, sea_place_0(p)).xy + sea_fetch(u_sea_orbit_1, sea_place_1(p)).xy;
}
