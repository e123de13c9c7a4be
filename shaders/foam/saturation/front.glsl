// Foam from the wave's front (Yingst, Alford and Parberry 2011), with its own or the waves' phases.

// @part own
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

// @part shared
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

// @part gate
// How much of a group of waves foams: by the length of their sum, 1 where all crests meet.
uniform vec2 u_front_group; // share of the greatest sum where foam starts, and where it is full

float front_gate(float rho) {
    return FRONT_GATED ? smoothstep(u_front_group.x, u_front_group.y, rho) : 1.0;
}

// @part profile
// f = E^cot(psi/2) / C, up to 4: the paper's exp(-tan(theta/2 + delta)) / C with its pole moved to psi = 0.
uniform float u_front_intensity; // C
uniform float u_front_log_base;  // ln E

// The half angle's cotangent is (rho + x) / y = y / (rho - x): no tangent to be inaccurate near its pole, and of the two
// forms the one that does not cancel.
float front_profile(vec2 signal, float rho) {
    float exponent;
    if (signal.x > 0.0) {
        exponent = signal.y == 0.0 ? 80.0 : clamp((rho + signal.x) / signal.y, -80.0, 80.0);
    } else {
        exponent = rho > 0.0 ? signal.y / (rho - signal.x) : 0.0;
    }
    return min(exp(u_front_log_base * exponent) / u_front_intensity, 4.0);
}

// @part plain
// Foam from the wave's front (Yingst, Alford and Parberry 2011), at a point. Without unit, [0, 4].
float front_saturation(vec2 p, float height, Footprint fp) {
    vec2 by_x;
    vec2 by_z;
    vec2 signal = front_signal(p, by_x, by_z);
    float rho = length(signal);
    return front_gate(rho) * front_profile(signal, rho);
}

// @part even
// Fronts foam alike everywhere.
float front_patch(vec2 q, Footprint fp) {
    return 0.0;
}

// @part patches
// Fronts foam in patches: the waves' sum counts for more in some places than in others. The patches drift with the foam and change.
// docs/formulae.md, section 4.
uniform float u_front_patch_phase[3]; // the eye's place in the noise: x, z, time; rad, a turn is 256 cells
uniform vec2 u_front_patch;           // size of the largest, m; standard deviation, of the sum

float front_patch(vec2 q, Footprint fp) {
    vec3 place = vec3(u_front_patch_phase[0], u_front_patch_phase[1], u_front_patch_phase[2]) * 40.7436654315252;
    float width = FRONT_FILTERED ? sqrt(max(dot(fp.x, fp.x), dot(fp.y, fp.y))) / u_front_patch.x : 0.0;
    return u_front_patch.y * fractal_3(place + vec3(q / u_front_patch.x, 0.0), width, 3, uint(FRONT_SEED));
}

// @part seen
// A front's phase, and what the eye sees of it. docs/formulae.md, section 4.
uniform float u_front_relief; // slope amplitude of the sinusoid that is as steep as the waves

// How fast the phase of a sum of waves changes along x and z, rad/m. signal: the sum; by_x, by_z: its derivatives.
vec2 front_gradient(vec2 signal, vec2 by_x, vec2 by_z) {
    return vec2(signal.x * by_x.y - signal.y * by_x.x, signal.x * by_z.y - signal.y * by_z.x) / max(dot(signal, signal), 1e-4);
}

// Waves hide their backs from a ray that falls by less than they do. psi and width: the phases under the footprint; out: those
// of them that the eye sees. along: how fast psi grows along the view, rad/m; across: in any direction.
// Of a sinusoid whose slope is q times exceeded the eye sees the phases from q past its crest to sqrt(4 pi q) before it (parabolas at
// the crests), which tends to all of them where q is 1. Footprints wider than this arc take it whole.
void front_seen(vec2 p, float height, float along, float across, inout float psi, inout float width) {
    float over = u_eye_height - height;
    float relief = u_front_relief * abs(along);
    float q = min(abs(over) * across / max(relief * length(p), 1e-20), 1.0);
    float before = sqrt(2.0 * TAU * q);
    float q4 = q * q * q * q;
    float q16 = q4 * q4 * q4 * q4;
    float arc = max((q + before) / max(1.0 - q16, 1e-6), 1e-5);
    float crest = over < 0.0 ? FRONT_CREST - PI : FRONT_CREST;
    float middle = crest + (along < 0.0 ? 0.5 : -0.5) * (before - q);
    psi = wrap_phase(psi + smoothstep(1.0, 2.0, width / arc) * wrap_phase(middle - psi));
    width = min(width, arc);
}

// @part filtered
// Foam from the wave's front, min(f, 1) averaged over the phases that the footprint covers. Without unit, [0, 1].
// The table's row i holds (a, b, c, d): the integral of f from FRONT_FULL, where f = 1, to the phase FRONT_FULL + (i + t) h
// is a + h (b t + c t^2 + d t^3), t in [0, 1].
uniform sampler2D u_front_integral;

// Integral over [low, high], which lies in [-2 pi, 2 pi], no longer than a period.
float front_integral(float low, float high) {
    float cell = (TAU - FRONT_FULL) / float(FRONT_NODES - 1);
    bool crosses = low < 0.0 && high > 0.0;
    // Both in [0, 2 pi].
    float from = low < 0.0 ? low + TAU : low;
    float to = high > 0.0 ? high : high + TAU;
    float plateau = min(to, FRONT_FULL) - min(from, FRONT_FULL) + (crosses ? FRONT_FULL : 0.0);
    from = max(from, FRONT_FULL);
    to = max(to, FRONT_FULL);
    float x = (from - FRONT_FULL) / cell;
    float y = (to - FRONT_FULL) / cell;
    int i = min(as_int(floor(x)), FRONT_NODES - 2);
    int j = min(as_int(floor(y)), FRONT_NODES - 2);
    vec4 first = texel_at(u_front_integral, ivec2(i, 0));
    vec4 last = texel_at(u_front_integral, ivec2(j, 0));
    float t = min(x - float(i), 1.0);
    float u = min(y - float(j), 1.0);
    // Within one cell the difference is taken by hand: subtracted, a short window would lose its digits.
    if (i == j && !crosses) {
        return plateau + (to - from) * (first.y + first.z * (t + u) + first.w * (t * t + t * u + u * u));
    }
    float rest = (1.0 - t) * (first.y + first.z * (1.0 + t) + first.w * (1.0 + t + t * t));
    float begun = u * (last.y + u * (last.z + u * last.w));
    float between = j == i + 1 ? 0.0 : last.x - first.x - cell * (first.y + first.z + first.w);
    return plateau + cell * (rest + begun) + between + (crosses ? FRONT_FADING : 0.0);
}

// Mean over psi -+ width/2; psi in [-pi, pi].
float front_mean(float psi, float width) {
    // Wide windows: whole periods first; what is left lies round psi, or round its opposite after an odd number of turns.
    float turns = floor(width / TAU);
    float rest = min(width - turns * TAU, TAU);
    float centre = mod(turns, 2.0) > 0.5 ? (psi > 0.0 ? psi - PI : psi + PI) : psi;
    float low = centre - 0.5 * rest;
    float high = centre + 0.5 * rest;
    float whole = FRONT_FULL + FRONT_FADING;
    if (turns > 0.0 && rest < 1e-3) {
        return whole / TAU;
    }
    return clamp((front_integral(low, high) + turns * whole) / ((high - low) + turns * TAU), 0.0, 1.0);
}

float front_saturation(vec2 p, float height, Footprint fp) {
    vec2 by_x;
    vec2 by_z;
    vec2 signal = front_signal(p, by_x, by_z);
    float rho2 = dot(signal, signal);
    vec2 gradient = front_gradient(signal, by_x, by_z);
    float width = abs(dot(gradient, fp.x)) + abs(dot(gradient, fp.y));
    float psi = rho2 > 0.0 ? atan(signal.y, signal.x) : 0.0;
    front_seen(p, height, dot(gradient, p) / max(length(p), 1e-6), length(gradient), psi, width);
    return front_gate(sqrt(rho2)) * front_mean(psi, clamp(width, 1e-5, 1e4));
}

// @part living
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

// @part way_none
// Foam lies where it is.
vec2 front_way(vec2 p) {
    return vec2(0.0);
}

// @part way_own
// From p to where its water rests, m, by the front's own waves.
uniform vec2 u_front_orbit[FRONT_COUNT]; // along the heading, m

vec2 front_way(vec2 p) {
    vec2 way = vec2(0.0);
    for (int i = 0; i < FRONT_COUNT; ++i) {
        way += whole_sine_cosine(wrap_phase(front_phase(i, p))).y * u_front_orbit[i];
    }
    return way;
}

// @part way_shared
// From p to where its water rests, m, as it was found when p was shaded.
vec2 front_way(vec2 p) {
    return parametric_carried;
}
