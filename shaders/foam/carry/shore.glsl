// Where the water at p rests off a coast: the open sea's share of its orbits, and to and fro along the gradient of the waves' phase.
vec2 carry(vec2 p) {
    vec2 open = open_carry(p);
    ShoreField f = shore_field(shore_place(p));
    return f.here.a * open + shore_carried(f, shore_turn(f.here.r));
}
