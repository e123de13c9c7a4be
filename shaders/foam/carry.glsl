// The way from a point to where its water rests.

// @part still
// Water without waves lies where it rests.
vec2 still_carry(vec2 p) {
    return vec2(0.0);
}

// @part parametric
// Where the water at p rests: the first harmonic of each wave carries it to and fro, forward on the crest. To first order in the slope,
// so foam is drawn together on crests and spread in troughs. docs/formulae.md, section 5.
vec2 parametric_carry(vec2 p) {
    vec2 way = vec2(0.0);
    for (int i = 0; i < PARAMETRIC_COUNT; ++i) {
        vec2 of_half = parametric_place(i, p);
        way += 2.0 * of_half.x * of_half.y * u_parametric_mean[i].z * u_parametric[i].xy;
    }
    return way;
}

// @part parametric_shared
// Where the water at p rests, as it was found when p was shaded.
vec2 parametric_carry(vec2 p) {
    return parametric_carried;
}

// @part sea
// Where the water at p rests, from maps of the tiles that raise the sea.
uniform sampler2D u_sea_orbits; // x, z: to the resting place, m

vec2 sea_carry(vec2 p) {
    return sea_fetch_four(u_sea_orbits, sea_place_0(p), 0).xy + sea_fetch_four(u_sea_orbits, sea_place_1(p), 1).xy;
}

// @part sea_orbit
// From each second corner of a tile to where the water that is there rests, m. Two tiles over one another, each with its first row once
// more at its end, so that bilinear reads need no wrap there.
uniform vec3 u_sea_other; // the second tile, as the first

void main() {
    int side = SEA_SIZE / 2;
    ivec2 at = as_int(floor(gl_FragCoord.xy));
    int row = at.y / (side + 1);
    sea_block = row == 0 ? u_sea_block : u_sea_other;
    vec2 corner = float(SEA_DISPLACED) / float(side) * vec2(at.x, (at.y - row * (side + 1)) & (side - 1));
    o_tile = vec4(sea_block.y * (rested(corner, corner, SEA_NEWTON_ORBIT) - corner), 0.0, 0.0);
}

// @part shore
// Where the water at p rests off a coast: the open sea's share of its orbits, and to and fro along the gradient of the waves' phase.
vec2 carry(vec2 p) {
    vec2 open = open_carry(p);
    ShoreField f = shore_field(shore_place(p));
    return f.here.a * open + shore_carried(f, shore_turn(f.here.r));
}

// @part shared
// Where the water at p rests off a coast without surf.
vec2 carry(vec2 p) {
    return shore_share(shore_place(p)).x * open_carry(p);
}

// @part surf
// Where the water at p rests off a coast: the open sea's share of its orbits, and to and fro with the surf, as its foam was asked for.
vec2 carry(vec2 p) {
    return surf_carried.z * open_carry(p) + surf_carried.xy;
}
