// Where the water at p rests, by waves in groups: even_carry is that of waves of one height.
vec2 parametric_carry(vec2 p) {
    return wave_groups(p).x * even_carry(p);
}
