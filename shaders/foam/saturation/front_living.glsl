// Foam born at a front and left on the water, where it decays by the second: min(exp((FRONT_BORN - phase since)/FRONT_LIFE), 1) of the
// last three fronts that passed the water, each as strong as its group was then. Mean over the phases that the footprint covers.
// docs/formulae.md, section 4.
uniform vec4 u_living[FRONT_COUNT]; // frequency for water that drifts, over the mean; cosine and sine of the turn from front to front; weight

// From 0 to phase, of foam of strength 1; whole turns are whole fronts.
float living_integral(float phase) {
    float turns = floor(phase / TAU);
    float rest = phase - TAU * turns;
    return turns * FRONT_WHOLE + min(rest, FRONT_BORN) + FRONT_LIFE * (1.0 - exp(min(FRONT_BORN - rest, 0.0) / FRONT_LIFE));
}

float living_left(float phase) {
    return exp(min(FRONT_BORN - phase, 0.0) / FRONT_LIFE);
}

float front_saturation(vec2 p, float height, Footprint fp) {
    vec2 by_x;
    vec2 by_z;
    vec2 signal = front_signal(p, by_x, by_z);
    float rho2 = dot(signal, signal);
    vec2 gradient = front_gradient(signal, by_x, by_z);
    float psi = rho2 > 0.0 ? atan(signal.y, signal.x) : 0.0;
    // Foam lies on its water: where that rests, the waves went by.
    vec2 way = front_way(p);
    vec2 q = p + way;
    float more = front_patch(q, fp);
    psi = wrap_phase(psi + dot(gradient, way));
    float since = psi < 0.0 ? psi + TAU : psi;
    // How strong the waves stood together when the last three fronts passed.
    vec2 first = vec2(0.0);
    vec2 second = vec2(0.0);
    vec2 third = vec2(0.0);
    for (int i = 0; i < FRONT_COUNT; ++i) {
        vec4 wave = u_living[i];
        vec2 turn = wave.yz;
        vec2 now = wave.w * whole_sine_cosine(wrap_phase(front_phase(i, q) - wave.x * since)).yx;
        first += now;
        now = vec2(now.x * turn.x + now.y * turn.y, now.y * turn.x - now.x * turn.y);
        second += now;
        third += vec2(now.x * turn.x + now.y * turn.y, now.y * turn.x - now.x * turn.y);
    }
    // What the third leaves fades out before it is the fourth.
    float left = exp(-TAU / FRONT_LIFE);
    float before = max(front_gate(front_group(q, since + TAU) * length(second) + more), left * front_gate(front_group(q, since + 2.0 * TAU) * length(third) + more) * (1.0 - smoothstep(0.5, 1.0, since / TAU)));
    float here = max(front_gate(front_group(q, since) * length(first) + more), left * before);
    if (!FRONT_FILTERED) {
        return here * living_left(since);
    }
    float width = abs(dot(gradient, fp.x)) + abs(dot(gradient, fp.y));
    front_seen(p, height, dot(gradient, p) / max(length(p), 1e-6), length(gradient), psi, width);
    since = psi < 0.0 ? psi + TAU : psi;
    width = clamp(width, 1e-5, 1e4);
    float low = since - 0.5 * width;
    float high = since + 0.5 * width;
    if (low > 0.0 && high < TAU && width < 0.02) {
        return here * living_left(since);
    }
    // Ahead of the front lies what those before it left; behind the next, what that one leaves now.
    float next = max(front_gate(sqrt(rho2) + more), left * here);
    float covered = here * (living_integral(min(high, 0.9999999 * TAU)) - living_integral(max(low, 0.0)))
        - before * living_integral(min(low, 0.0)) + next * (high > TAU ? living_integral(high) - FRONT_WHOLE : 0.0);
    return clamp(covered / width, 0.0, 1.0);
}
