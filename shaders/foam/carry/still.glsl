// Water without waves lies where it rests.
vec2 still_carry(vec2 p) {
    return vec2(0.0);
}
