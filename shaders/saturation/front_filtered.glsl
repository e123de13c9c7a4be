// Foam from the wave's front, min(f, 1) averaged over the phases that the footprint covers. Without unit, [0, 1].
// The integral's table is piecewise cubic: node values and slopes (f itself), from FRONT_FULL, where f = 1, to 2 pi.
uniform sampler2D u_front_integral;

// Integral from 0; psi in [FRONT_FULL, 2 pi].
float front_integral(float psi) {
    float x = (psi - FRONT_FULL) * (float(FRONT_NODES - 1) / (TAU - FRONT_FULL));
    int i = clamp(int(x), 0, FRONT_NODES - 2);
    vec2 a = texelFetch(u_front_integral, ivec2(i, 0), 0).rg;
    vec2 b = texelFetch(u_front_integral, ivec2(i + 1, 0), 0).rg;
    float t = clamp(x - float(i), 0.0, 1.0);
    float h = (TAU - FRONT_FULL) / float(FRONT_NODES - 1);
    float u = 1.0 - t;
    return a.x * u * u * (1.0 + 2.0 * t) + b.x * t * t * (1.0 + 2.0 * u) + h * t * u * (a.y * u - b.y * t);
}

float front_at(float psi) {
    return front_profile(vec2(cos(psi), sin(psi)), 1.0);
}

// Integral of min(f, 1) over [a, b], which lies within one period that starts at `start`.
float front_within(float a, float b, float start) {
    float full = start + FRONT_FULL;
    float plateau = max(min(b, full) - min(a, full), 0.0);
    float from = max(a, full);
    float to = max(b, full);
    float span = to - from;
    float fading = 0.0;
    if (span > 0.15) {
        fading = front_integral(to - start) - front_integral(from - start);
    } else if (span > 0.0) {
        // Differences of a table lose digits on a short span: three-point Gauss there.
        float mid = 0.5 * (from + to);
        float arm = 0.387298334620742 * span;
        fading = span * (5.0 * (front_at(mid - arm) + front_at(mid + arm)) + 8.0 * front_at(mid)) / 18.0;
    }
    return plateau + fading;
}

// Mean over psi -+ width/2; psi in [-pi, pi].
float front_mean(float psi, float width) {
    float whole = front_integral(TAU);
    // Wide windows: whole periods first; what is left lies round psi, or round its opposite after an odd number of turns.
    float turns = floor(width / TAU);
    float rest = min(width - turns * TAU, TAU);
    float centre = mod(turns, 2.0) > 0.5 ? (psi > 0.0 ? psi - PI : psi + PI) : psi;
    float low = centre - 0.5 * rest;
    float high = centre + 0.5 * rest;
    if (turns > 0.0 && rest < 1e-3) {
        return whole / TAU;
    }
    float sum = front_within(max(low, 0.0), max(high, 0.0), 0.0) + front_within(min(low, 0.0), min(high, 0.0), -TAU);
    return clamp((sum + turns * whole) / ((high - low) + turns * TAU), 0.0, 1.0);
}

float front_saturation(vec2 p, float height, Footprint fp) {
    vec2 signal = vec2(0.0);
    vec2 by_x = vec2(0.0);
    vec2 by_z = vec2(0.0);
    for (int i = 0; i < FRONT_COUNT; ++i) {
        vec3 wave = u_front_wave[i].xyz;
        float psi = wrap_phase(u_front_phase[i] - dot(wave.xy, p));
        vec2 term = wave.z * vec2(cos(psi), sin(psi));
        signal += term;
        // d psi / d p = -k
        vec2 turned = vec2(term.y, -term.x);
        by_x += wave.x * turned;
        by_z += wave.y * turned;
    }
    float rho2 = dot(signal, signal);
    vec2 gradient = vec2(signal.x * by_x.y - signal.y * by_x.x, signal.x * by_z.y - signal.y * by_z.x) / max(rho2, 1e-4);
    float width = abs(dot(gradient, fp.x)) + abs(dot(gradient, fp.y));
    float psi = rho2 > 0.0 ? atan(signal.y, signal.x) : 0.0;
    return front_gate(sqrt(rho2)) * front_mean(psi, clamp(width, 1e-5, 1e4));
}
