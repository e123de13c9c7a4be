// Foam born at a front and left on the water, where it decays by the second: min(exp((FRONT_BORN - phase since)/FRONT_LIFE), 1) of the
// last three fronts that passed the water, each as strong as its group was then. Mean over the phases that the footprint covers.
// docs/formulae.md, section 4.
uniform vec4 u_living_wave[FRONT_COUNT];   // k.x, k.z (rad/m), weight, frequency for water that drifts (rad/s)
uniform float u_living_phase[FRONT_COUNT];
uniform vec2 u_living_orbit[FRONT_COUNT];  // along the heading, m
uniform float u_living_rate;               // mean frequency, rad/s

// From 0 to phase, of foam of strength 1; whole turns are whole fronts.
float living_integral(float phase) {
    float turns = floor(phase / TAU);
    float rest = phase - TAU * turns;
    return turns * FRONT_WHOLE + min(rest, FRONT_BORN) + FRONT_LIFE * (1.0 - exp(min(FRONT_BORN - rest, 0.0) / FRONT_LIFE));
}

// How strong the waves stood together a time ago, by the gate.
float living_born(vec2 p, float ago) {
    vec2 sum = vec2(0.0);
    for (int i = 0; i < FRONT_COUNT; ++i) {
        vec4 wave = u_living_wave[i];
        float psi = wrap_phase(u_living_phase[i] - dot(wave.xy, p) - wave.w * ago);
        sum += wave.z * vec2(cos(psi), sin(psi));
    }
    return front_gate(length(sum));
}

float front_saturation(vec2 p, float height, Footprint fp) {
    // Foam lies on its water: where that rests, the waves went by.
    vec2 lying = p;
    for (int i = 0; i < FRONT_COUNT; ++i) {
        float psi = wrap_phase(u_living_phase[i] - dot(u_living_wave[i].xy, p));
        lying += cos(psi) * u_living_orbit[i];
    }
    vec2 sum = vec2(0.0);
    vec2 rates = vec2(0.0);
    vec2 by_x = vec2(0.0);
    vec2 by_z = vec2(0.0);
    for (int i = 0; i < FRONT_COUNT; ++i) {
        vec4 wave = u_living_wave[i];
        float psi = wrap_phase(u_living_phase[i] - dot(wave.xy, lying));
        vec2 term = wave.z * vec2(cos(psi), sin(psi));
        vec2 turned = vec2(term.y, -term.x);
        sum += term;
        rates += wave.w * term;
        by_x += wave.x * turned;
        by_z += wave.y * turned;
    }
    float rho2 = max(dot(sum, sum), 1e-4);
    float rate = clamp(dot(sum, rates) / rho2, 0.5 * u_living_rate, 2.0 * u_living_rate);
    vec2 gradient = vec2(sum.x * by_x.y - sum.y * by_x.x, sum.x * by_z.y - sum.y * by_z.x) / rho2;
    float psi = rho2 > 1e-4 ? atan(sum.y, sum.x) : 0.0;

    // Since the last front, and how strong it and the two before it were; what the third leaves fades out before it is the fourth.
    float since = psi < 0.0 ? psi + TAU : psi;
    float left = exp(-TAU / FRONT_LIFE);
    float first = living_born(lying, since / rate);
    float second = living_born(lying, (since + TAU) / rate);
    float third = living_born(lying, (since + 2.0 * TAU) / rate) * (1.0 - smoothstep(0.5, 1.0, since / TAU));
    float before = max(second, left * third);
    float here = max(first, left * before);
    if (!FRONT_FILTERED) {
        return here * exp(min(FRONT_BORN - since, 0.0) / FRONT_LIFE);
    }
    float width = abs(dot(gradient, fp.x)) + abs(dot(gradient, fp.y));
    front_seen(p, height, dot(gradient, p) / max(length(p), 1e-6), length(gradient), psi, width);
    since = psi < 0.0 ? psi + TAU : psi;
    width = clamp(width, 1e-5, 1e4);
    float low = since - 0.5 * width;
    float high = since + 0.5 * width;
    if (low > 0.0 && high < TAU && width < 0.02) {
        return here * exp(min(FRONT_BORN - since, 0.0) / FRONT_LIFE);
    }
    // Ahead of the front lies what those before it left; behind the next, what that one leaves now.
    float next = max(front_gate(length(sum)), left * here);
    float covered = here * (living_integral(min(high, 0.9999999 * TAU)) - living_integral(max(low, 0.0)))
        - before * living_integral(min(low, 0.0)) + next * (high > TAU ? living_integral(high) - FRONT_WHOLE : 0.0);
    return clamp(covered / width, 0.0, 1.0);
}
