// Where the water at p rests off a coast: the open sea's share of its orbits, and to and fro with the surf, as its foam was asked for.
vec2 carry(vec2 p) {
    return surf_carried.z * open_carry(p) + surf_carried.xy;
}
