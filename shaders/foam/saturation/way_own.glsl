// From p to where its water rests, m, by the front's own waves.
uniform vec2 u_front_orbit[FRONT_COUNT]; // along the heading, m

vec2 front_way(vec2 p) {
    vec2 way = vec2(0.0);
    for (int i = 0; i < FRONT_COUNT; ++i) {
        way += whole_sine_cosine(wrap_phase(front_phase(i, p))).y * u_front_orbit[i];
    }
    return way;
}
