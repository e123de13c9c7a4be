// The four generations of patches that are alive: a new one every DRIFT_GENERATION seconds, each four times as long alive.
uniform vec2 u_drift_clock; // t modulo 1024 generations and modulo one, s: reduced in float64

float drift_age(int j) {
    return u_drift_clock.y + float(j) * DRIFT_GENERATION;
}

// The generation's number modulo 1024: the difference is a whole number of generations.
uint drift_generation(int j) {
    return uint(int(floor((u_drift_clock.x - u_drift_clock.y) / DRIFT_GENERATION + 0.5)) - j + 1024) & 1023u;
}

// How much of each generation there is: sin^2 over its life, 2 together at any time; what is older than the window is gone.
vec4 drift_shares() {
    vec4 age = u_drift_clock.y + vec4(0.0, 1.0, 2.0, 3.0) * DRIFT_GENERATION;
    vec4 s = sin(0.25 * PI / DRIFT_GENERATION * age);
    vec4 shares = s * s;
    return DRIFT_CUT ? shares * (1.0 - smoothstep(0.75 * DRIFT_WINDOW, DRIFT_WINDOW, age)) : shares;
}
