// Rows along the wind in which foam gathers: ridges of gradient noise, eight times as long as they are apart; mean 0, in [-1, 1].
// docs/formulae.md, section 5. The place is reduced in float64; the noise repeats after 256 cells.
uniform float u_windrow_phase[2]; // the eye's place in the noise, along the wind and across it; rad, a turn is 256 cells
uniform vec4 u_windrow_matrix;    // rows of the turn, in cells, 1/m
uniform float u_windrows;

float windrow(vec2 p, Footprint fp) {
    mat2 turn = transpose(mat2(u_windrow_matrix.xy, u_windrow_matrix.zw));
    float kept = 1.0;
    if (SURFACE_FILTER) {
        vec2 x = turn * fp.x;
        vec2 y = turn * fp.y;
        kept = 1.0 - smoothstep(0.15, 0.6, sqrt(max(dot(x, x), dot(y, y))));
        if (kept <= 0.0) {
            return 0.0;
        }
    }
    vec2 place = vec2(u_windrow_phase[0], u_windrow_phase[1]) * 40.7436654315252 + turn * p;
    return u_windrows * kept * max(1.0 - WINDROW_RIDGE * abs(noise_2(place, uint(WINDROW_SEED))), -1.0);
}
