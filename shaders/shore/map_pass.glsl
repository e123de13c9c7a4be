// What shore waves need to know of a place: r phase (periods), g height (m), b skew (row of the table, 0 to 1), a how much of
// the open sea's waves is left. docs/formulae.md, section 8.
out vec4 o_map;

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy);
    vec2 q = (gl_FragCoord.xy / u_viewport - 0.5) * u_shore_size;
    vec2 at = smoothed(here);
    float d = at.x;
    float depth = at.y;

    // Sobel's gradient of the distance: points out to sea; short where coasts on two sides are as near.
    vec2 g = vec2(0.0);
    for (int i = -1; i <= 1; ++i) {
        float weight = i == 0 ? 2.0 : 1.0;
        g.x += weight * (smoothed(here + ivec2(1, i)).x - smoothed(here + ivec2(-1, i)).x);
        g.y += weight * (smoothed(here + ivec2(i, 1)).x - smoothed(here + ivec2(i, -1)).x);
    }
    g *= u_viewport.x / (8.0 * u_shore_size);
    vec3 arrival = shore_arrival(here, d, g);
    float open = u_shore_shelter > 0.0 ? smooth_between(0.85 * u_shore_shelter, 1.1 * u_shore_shelter, length(q)) : 1.0;

    float breaks = max(u_surf_height, 0.05) / 0.78;
    float shoal = depth >= breaks ? sqrt(sqrt(breaks / max(depth, breaks))) : 0.3 + 0.7 * smooth_between(0.0, breaks, depth);
    float far = 1.0 - smooth_between(0.45 * u_shore_deep, 0.9 * u_shore_deep, depth);
    float inland = smooth_between(-1.2 * max(u_surf_height, 0.05) / u_shore_slope, 0.0, d);
    float sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        sum += sin(wrap_phase(u_surf_mask_phase[i] + dot(u_surf_mask[i], q)));
    }
    float rhythm = 1.0 - u_surf_variation * smooth_between(-0.8, 0.8, 0.5 * sum);

    o_map = vec4(
        arrival.x,
        u_surf_height * shoal * far * inland * arrival.y * arrival.z * open * rhythm,
        1.0 - smooth_between(breaks, 2.5 * breaks, depth),
        smooth_between(0.0, 0.6 * u_shore_deep, depth) * mix(0.1, 1.0, open));
}
