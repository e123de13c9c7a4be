// Complex amplitudes of a tile's waves at one moment, h0(k) e^(-i w t) + conj(h0(-k)) e^(i w t) (Tessendorf 2001); m.
// w t is a whole number of turns times the moment's place in the loop: coarse and fine part each exact in float32.
uniform sampler2D u_sea_spectrum; // lower half h0, upper half turns in a loop; wave (ix, iz) at (ix, iz) + SEA_BAND, tiles side by side
uniform float u_sea_loop;         // t modulo SEA_LOOP, s
uniform float u_sea_fine;         // t modulo SEA_LOOP / 1024, s

vec2 complex_product(vec2 a, vec2 b) {
    return vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}

// The whole wavevector of a texel of a transform of `size`; beyond the band and at Nyquist, whose wave has no partner: false.
bool wave_of(ivec2 texel, int size, out ivec2 k) {
    k = texel - size * ivec2(greaterThanEqual(texel, ivec2(size / 2)));
    int held = min(SEA_BAND, size / 2);
    return all(lessThan(abs(k), ivec2(held))) && k != ivec2(0);
}

// `before`: seconds before the frame's time.
vec2 amplitude(ivec2 k, int tile, float before) {
    ivec2 at = ivec2(2 * SEA_BAND * tile + SEA_BAND, SEA_BAND);
    vec2 along = texel_at(u_sea_spectrum, at + k).rg;
    vec2 opposite = texel_at(u_sea_spectrum, at - k).rg;
    // One of the two is 0 where waves against the wind are suppressed, and then only the other knows its turns.
    float turns = max(
        texel_at(u_sea_spectrum, at + k + ivec2(0, 2 * SEA_BAND)).r,
        texel_at(u_sea_spectrum, at - k + ivec2(0, 2 * SEA_BAND)).r);
    float coarse = floor((u_sea_loop - u_sea_fine) * (1024.0 / SEA_LOOP) + 0.5);
    // turns < 2^14 and coarse <= 2^10: their product is exact, and so is its fraction.
    float turn = fract(turns * coarse / 1024.0) + turns * ((u_sea_fine - before) / SEA_LOOP);
    float angle = TAU * (turn - floor(turn + 0.5));
    vec2 back = vec2(cos(angle), -sin(angle));
    return complex_product(along, back) + complex_product(opposite * vec2(1.0, -1.0), back * vec2(1.0, -1.0));
}
