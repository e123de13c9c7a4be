// What carries a boat: the drawn surface, or where that is too shallow the ground under its keel.
float boat_support(vec2 p, float draught) {
    return max(waves(p).x, shore_floor(shore_place(p)).x + draught);
}
