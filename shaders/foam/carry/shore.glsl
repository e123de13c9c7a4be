// Where the water at p rests off a coast: the open sea's share of its orbits, and to and fro along the gradient of the waves' phase.
vec2 carry(vec2 p) {
    vec2 open = open_carry(p);
    ShoreField f = shore_field(shore_place(p));
    vec2 out_to_sea = vec2(f.along_x.r, f.along_z.r);
    return f.here.a * open + 1.5 * f.here.g * sin(TAU * shore_turn(f.here.r)) / max(length(out_to_sea), 1e-6) * out_to_sea;
}
