// Kelvin's wake (Thomson 1887) by stationary phase: behind a bow that moves at v stand two systems of waves, across and
// spreading, inside 19.5 degrees. With k = g / v^2 and t the tangent of a wave's heading, its phase is
// k sqrt(1 + t^2) (x - t z), where 2 z t^2 - x t + z = 0; its wavevector k sqrt(1 + t^2) (1, -t). Metres; exact to float32.

// The smoothstep and its derivative.
vec2 wake_step(float low, float high, float x) {
    float width = high - low;
    float u = clamp((x - low) / width, 0.0, 1.0);
    return vec2(u * u * (3.0 - 2.0 * u), 6.0 * u * (1.0 - u) / width);
}

// at: behind the bow and aside, aside >= 0 (m). wake: k (rad/m), height (m), length (m), shortest waves (rad/m).
// Returns height, its slopes behind and aside, and the mean square wavenumber.
vec4 wake_pattern(vec2 at, vec4 wake, float size, float radius) {
    float q = at.y / max(at.x, 1e-3);
    float square = 1.0 - 8.0 * q * q;
    if (at.x <= 0.0 || square <= 0.0 || at.x >= wake.z || wake.y <= 0.0) {
        return vec4(0.0);
    }
    float root = sqrt(square);
    float fall = TAU / (TAU + wake.x * at.x);
    vec2 t = vec2(2.0 * q / (1.0 + root), (1.0 + root) / (4.0 * max(q, 1e-4)));
    vec2 secant = sqrt(1.0 + t * t);
    vec2 k = wake.x * secant * secant;
    // At the edge of the wake both systems meet, and the phase has no second derivative: the wake opens from there.
    vec2 edge = wake_step(0.0, 0.5, square);
    vec2 begin = wake_step(0.0, 0.6 * size, at.x);
    vec2 end = wake_step(0.5 * wake.z, wake.z, at.x);
    vec2 side = wake_step(0.25 * radius, 0.4 * radius, at.y);
    float along = begin.x * (1.0 - end.x);
    float open = edge.x * along * (1.0 - side.x);
    // Waves much shorter than the hull is wide are not made; straight behind they would be endlessly short.
    vec2 a = wake.y * vec2(0.5 * sqrt(fall), pow(fall, 0.333333)) * exp(-min(k * k / (wake.w * wake.w), vec2(80.0)));
    // How the window, the fall and the shortest waves change with x, z and q.
    float bent = 8.0 * q / max(root, 1e-3);
    float on_q = -16.0 * q * edge.y * along * (1.0 - side.x);
    float on_x = edge.x * (begin.y * (1.0 - end.x) - begin.x * end.y) * (1.0 - side.x);
    float on_z = -edge.x * along * side.y;
    vec2 turn = vec2(2.0 / (1.0 + root) + 2.0 * q * bent / ((1.0 + root) * (1.0 + root)), -(bent * q + 1.0 + root) / (4.0 * max(q * q, 1e-8)));
    vec2 dull = -4.0 * wake.x / (wake.w * wake.w) * k * t * turn;
    vec2 a_q = a * (on_q + open * dull);
    vec2 a_x = a * (on_x - open * vec2(0.5, 0.333333) * fall * wake.x / TAU) - a_q * q / max(at.x, 1e-3);
    vec2 a_z = a * on_z + a_q / max(at.x, 1e-3);
    a *= open;
    vec2 phase = vec2(
        wrap_phase(wake.x * secant.x * (at.x - at.y * t.x)), wrap_phase(wake.x * secant.y * (at.x - at.y * t.y)));
    vec2 wave = cos(phase);
    vec2 rise = -a * sin(phase) * wake.x * secant;
    vec2 weight = a * a * k * k;
    return vec4(
        dot(a, wave), rise.x + rise.y + dot(a_x, wave), -dot(rise, t) + dot(a_z, wave),
        dot(weight, k * k) / max(weight.x + weight.y, 1e-12));
}
