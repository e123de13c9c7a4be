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
    int i = min(int(x), FRONT_NODES - 2);
    int j = min(int(y), FRONT_NODES - 2);
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
