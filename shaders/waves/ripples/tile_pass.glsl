// Slopes of one tile of ripples, drawn every frame: r, g hold the longer band, b, a the shorter. docs/formulae.md, section 2.
uniform vec2 u_viewport;
uniform vec4 u_ripples_wave[RIPPLE_WAVES]; // k.x, k.z (rad/m), slope, unused
uniform float u_ripples_phase[RIPPLE_WAVES];
uniform float u_ripples_tile;
out vec4 o_slopes;

void main() {
    vec2 p = gl_FragCoord.xy / u_viewport * u_ripples_tile;
    vec2 bands[2] = vec2[2](vec2(0.0), vec2(0.0));
    for (int i = 0; i < RIPPLE_WAVES; ++i) {
        vec3 wave = u_ripples_wave[i].xyz;
        vec2 slope = -wave.z * normalize(wave.xy) * whole_sine_cosine(wrap_phase(u_ripples_phase[i] - dot(wave.xy, p))).y;
        bands[i * 2 / RIPPLE_WAVES] += slope;
    }
    o_slopes = vec4(bands[0], bands[1]);
}
