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
