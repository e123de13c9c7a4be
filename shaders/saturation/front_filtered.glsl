// Foam from the wave's front, min(f, 1) averaged over the phases that the footprint covers. Without unit, [0, 1].
// The table's row i holds (a, b, c, d): the integral of f from FRONT_FULL, where f = 1, to the phase FRONT_FULL + (i + t) h
// is a + h (b t + c t^2 + d t^3), t in [0, 1].
uniform sampler2D u_front_integral;
uniform float u_front_relief; // slope amplitude of the sinusoid that is as steep as the waves

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
    vec4 first = texelFetch(u_front_integral, ivec2(i, 0), 0);
    vec4 last = texelFetch(u_front_integral, ivec2(j, 0), 0);
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

float front_saturation(vec2 p, float height, Footprint fp) {
    vec2 by_x;
    vec2 by_z;
    vec2 signal = front_signal(p, by_x, by_z);
    float rho2 = dot(signal, signal);
    vec2 gradient = vec2(signal.x * by_x.y - signal.y * by_x.x, signal.x * by_z.y - signal.y * by_z.x) / max(rho2, 1e-4);
    float width = abs(dot(gradient, fp.x)) + abs(dot(gradient, fp.y));
    float psi = rho2 > 0.0 ? atan(signal.y, signal.x) : 0.0;
    front_seen(p, height, dot(gradient, p) / max(length(p), 1e-6), length(gradient), psi, width);
    return front_gate(sqrt(rho2)) * front_mean(psi, clamp(width, 1e-5, 1e4));
}
