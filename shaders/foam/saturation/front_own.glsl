// The waves' sum as an analytic signal, with phases and wavenumbers of the front's own. docs/formulae.md, section 4.
uniform vec4 u_front_wave[FRONT_COUNT]; // k.x, k.z (rad/m), weight, unused
uniform float u_front_phase[FRONT_COUNT]; // holds 2 delta - pi, so that the pole stands at 0

// Of one wave; not wrapped.
float front_phase(int i, vec2 p) {
    return u_front_phase[i] - dot(u_front_wave[i].xy, p);
}

vec2 front_signal(vec2 p, out vec2 by_x, out vec2 by_z) {
    vec2 sum = vec2(0.0);
    by_x = vec2(0.0);
    by_z = vec2(0.0);
    for (int i = 0; i < FRONT_COUNT; ++i) {
        vec3 wave = u_front_wave[i].xyz;
        float psi = wrap_phase(front_phase(i, p));
        vec2 term = wave.z * vec2(cos(psi), sin(psi));
        // d psi / d p = -k
        vec2 turned = vec2(term.y, -term.x);
        sum += term;
        by_x += wave.x * turned;
        by_z += wave.y * turned;
    }
    return sum;
}
