// The table of drops: three texels each, and two numbers that follow from them.
uniform sampler2D u_spray_births;
uniform float u_spray_drag; // s

// part 0: birth, age; 1: velocity, radius; 2: strength, kind, seed, life. A strength of 0: not in the air.
vec4 spray_entry(sampler2D table, int i, int part) {
    return texel_at(table, ivec2(i % SPRAY_COLUMNS, part * SPRAY_ROWS + i / SPRAY_COLUMNS));
}

// Time constant of the air's drag (s) and fall without air (m/s2). Mist rides on the air that the burst has set in motion and hardly
// falls; the wind tears spindrift along at once; the water of a column is too much for the air.
vec2 spray_fall(float kind, float vary) {
    float tau = u_spray_drag * (0.6 + 0.8 * vary);
    return kind == SPRAY_SHEET ? vec2(tau, 9.81)
        : kind == SPRAY_MIST ? vec2(tau, 1.5)
        : kind == SPRAY_DRIFT ? vec2(0.5 * tau, 2.5)
        : vec2(4.0 * tau, 9.81);
}

// How long after its birth a drop is not seen, s: batches would come in beats.
float spray_delay(float kind, float share) {
    return SPRAY_BEAT * share * (kind == SPRAY_SHEET ? 0.35 : kind == SPRAY_COLUMN ? 0.0 : 0.9);
}
