// The waves' sum as an analytic signal where delta is pi/2: psi is theta, and the waves that were shaded have its sine and cosine.
uniform float u_front_share; // 1 over the sum of all amplitudes (1/m)

// Of one wave; not wrapped.
float front_phase(int i, vec2 p) {
    return u_parametric_phase[i] - dot(u_parametric[i].xy, p);
}

vec2 front_signal(vec2 p, out vec2 by_x, out vec2 by_z) {
    by_x = u_front_share * parametric_signal_x;
    by_z = u_front_share * parametric_signal_z;
    return u_front_share * parametric_signal;
}
