// What stands over the bounds that sources of waves declare, at places of a square: over them in height (m), in slope,
// over either bound of the way from here (m), and the most that the surface bends (1/m).
// SIDE: texels of the square. SPAN: m. GENTLER: what stones take off the slope. FEW, FEWEST: height and slopes of the
// short waves, and their bounds. ANGLE: of the way j steps out in direction i.
out vec4 o_start;

void main() {
    vec2 p = (gl_FragCoord.xy / SIDE - 0.5) * SPAN;
    vec3 here = waves(p);
    vec3 ray = vec3(p.x, 0.0, p.y);
    vec3 bounds = surface_bounds(ray, 0.0, 0.9);
    // Ways lead up to 4 m from here: those that stay beyond count as such.
    vec3 beyond = surface_beyond(ray, 0.0);
    if (1.0 - 4.0 / length(ray) >= beyond.x) {
        bounds.yz -= beyond.yz;
    }
    bounds.y -= GENTLER;
    vec3 few = FEW;
    vec3 fewest = FEWEST;
    float over = max(here.x - bounds.x, u_surface_trough - here.x);
    float steeper = length(here.yz) - bounds.y;
    float risen = 0.0;
    float bend = 0.0;
    float away = 0.02;
    for (int j = 0; j < 7; ++j) {
        for (int i = 0; i < 8; ++i) {
            float angle = ANGLE;
            vec2 s = away * vec2(cos(angle), sin(angle));
            vec3 there = waves(p + s);
            float line = here.x + dot(here.yz, s);
            // How far the surface stands over either bound.
            float first = here.x + bounds.y * away;
            float second = line + 0.5 * bounds.z * away * away;
            // The long waves bend less; the short ones stand over them by their height at most.
            float third = line - few.x - dot(few.yz, s) + fewest.x + 0.5 * (bounds.z - fewest.z) * away * away;
            risen = max(risen, there.x - min(min(first, second), third));
            bend = max(bend, (there.x - line) / (0.5 * away * away));
        }
        away *= 2.3;
    }
    o_start = vec4(over, steeper, risen, bend);
}
