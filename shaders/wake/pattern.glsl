// Kelvin's wake (Thomson 1887) by stationary phase: behind a bow that moves at v stand two systems of waves, across and
// spreading, inside 19.5 degrees. With k = g / v^2 and t the tangent of a wave's heading, its phase is
// k sqrt(1 + t^2) (x - t z), where 2 z t^2 - x t + z = 0; its wavevector k sqrt(1 + t^2) (1, -t). Metres; exact to float32.
// at: behind the bow and aside, aside >= 0 (m). wake: k (rad/m), height (m), length (m), shortest waves (rad/m).
// Returns height, its slopes behind and aside (of the phase alone), and the mean square wavenumber.
vec4 wake_pattern(vec2 at, vec4 wake, float size, float radius) {
    float q = at.y / max(at.x, 1e-3);
    float square = 1.0 - 8.0 * q * q;
    if (at.x <= 0.0 || square <= 0.0 || at.x >= wake.z || wake.y <= 0.0) {
        return vec4(0.0);
    }
    float root = sqrt(square);
    // At the edge of the wake both systems meet, and the phase has no second derivative.
    float open = smoothstep(0.0, 0.4, root) * smoothstep(0.0, 0.6 * size, at.x) * (1.0 - smoothstep(0.5 * wake.z, wake.z, at.x))
        * (1.0 - smoothstep(0.25 * radius, 0.4 * radius, at.y));
    float fall = TAU / (TAU + wake.x * at.x);
    vec2 t = vec2(2.0 * q / (1.0 + root), (1.0 + root) / (4.0 * max(q, 1e-4)));
    vec2 secant = sqrt(1.0 + t * t);
    vec2 k = wake.x * secant * secant;
    // Waves much shorter than the hull is wide are not made; straight behind they would be endlessly short.
    vec2 a = open * wake.y * vec2(0.5 * sqrt(fall), pow(fall, 0.333333) * exp(-min(k.y * k.y / (wake.w * wake.w), 80.0)));
    vec2 phase = vec2(
        wrap_phase(wake.x * secant.x * (at.x - at.y * t.x)), wrap_phase(wake.x * secant.y * (at.x - at.y * t.y)));
    vec2 rise = -a * sin(phase) * wake.x * secant;
    vec2 weight = a * a * k * k;
    return vec4(
        dot(a, cos(phase)), rise.x + rise.y, -dot(rise, t),
        dot(weight, k * k) / max(weight.x + weight.y, 1e-12));
}
