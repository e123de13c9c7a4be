// From p to where its water rests, m, as it was found when p was shaded.
vec2 front_way(vec2 p) {
    return parametric_carried;
}
