// From p to where its water rests, by a front's own waves in groups: even_way is that of waves of one height.
vec2 front_way(vec2 p) {
    return wave_groups(p).x * even_way(p);
}
