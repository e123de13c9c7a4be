// Slopes of the ripples where sunlight enters: at the corners of the grid, which close on themselves at the tile's ends.
uniform vec2 u_viewport;
uniform vec4 u_caustic_wave[CAUSTIC_WAVES]; // k.x, k.z (rad/m), slope, unused
uniform float u_caustic_phase[CAUSTIC_WAVES];
uniform float u_caustic_tile;               // m
out vec4 o_slopes;

void main() {
    vec2 p = floor(gl_FragCoord.xy) / u_viewport * u_caustic_tile;
    vec2 slope = vec2(0.0);
    for (int i = 0; i < CAUSTIC_WAVES; ++i) {
        vec3 wave = u_caustic_wave[i].xyz;
        slope -= wave.z * normalize(wave.xy) * whole_sine_cosine(wrap_phase(u_caustic_phase[i] - dot(wave.xy, p))).y;
    }
    o_slopes = vec4(slope, 0.0, 0.0);
}
