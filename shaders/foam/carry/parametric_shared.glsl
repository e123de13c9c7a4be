// Where the water at p rests, as it was found when p was shaded.
vec2 parametric_carry(vec2 p) {
    return parametric_carried;
}
