// Where the square of the shore lies: metres from its middle. docs/formulae.md, section 8.
uniform float u_shore_place[2]; // the eye from the square's middle, as a phase: pi is half of SHORE_PERIOD metres

vec2 shore_place(vec2 p) {
    return p + vec2(u_shore_place[0], u_shore_place[1]) * (SHORE_PERIOD / TAU);
}
