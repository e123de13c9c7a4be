// Waves with whole wavenumbers on two tiles (Gerstner): summed one by one, so each tile closes exactly.
uniform vec4 u_gerstner[GERSTNER_WAVES];       // waves along x and z of the tile, amplitude (m), frequency (rad/s)
uniform float u_gerstner_phase[GERSTNER_WAVES];

// First wave of a tile, and the one after its last.
ivec2 gerstner_waves(int tile) {
    return tile == 0 ? ivec2(0, GERSTNER_FIRST) : ivec2(GERSTNER_FIRST, GERSTNER_WAVES);
}

// Phase at a texel's corner: k.x is a whole number of parts of a turn.
float gerstner_theta(int wave, ivec2 texel, int size) {
    ivec2 k = ivec2(u_gerstner[wave].xy);
    int part = (k.x * texel.x + k.y * texel.y) & (size - 1);
    return wrap_phase(u_gerstner_phase[wave] + TAU / float(size) * float(part));
}
