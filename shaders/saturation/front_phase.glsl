// Phase of the waves' sum, its analytic signal: one wave gives the paper's theta exactly. docs/formulae.md, section 4.
uniform vec4 u_front_wave[FRONT_COUNT]; // k.x, k.z (rad/m), weight, unused
uniform float u_front_phase[FRONT_COUNT]; // holds 2 delta - pi, so that the pole stands at 0
uniform vec2 u_front_group; // share of the greatest sum where foam starts, and where it is full

vec2 front_signal(vec2 p) {
    vec2 sum = vec2(0.0);
    for (int i = 0; i < FRONT_COUNT; ++i) {
        vec3 wave = u_front_wave[i].xyz;
        float psi = wrap_phase(u_front_phase[i] - dot(wave.xy, p));
        sum += wave.z * vec2(cos(psi), sin(psi));
    }
    return sum;
}

float front_gate(float rho) {
    return FRONT_GATED ? smoothstep(u_front_group.x, u_front_group.y, rho) : 1.0;
}
