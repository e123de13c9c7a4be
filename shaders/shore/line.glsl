// Foam that the swash leaves on the sand: on all that it swept, thinning as on the water, and a line where it turned, which lasts longer.
// docs/formulae.md, section 8.
uniform float u_surf_line;

float land_foam(vec2 p, float ground, Footprint fp) {
    vec2 q = shore_place(p);
    ShoreField f = shore_field(q);
    // How high the ground is, in heights of the wave that runs up it.
    float reach = ground / max(f.here.g, 1e-3);
    if (reach >= 1.05) {
        return 0.0;
    }
    float since = shore_turn(f.here.r) - 1.0;
    float swept = (1.0 - smoothstep(0.85, 1.0, reach)) * exp(since / u_surf_life);
    float line = smoothstep(0.55, 0.9, reach) * (1.0 - smoothstep(0.95, 1.05, reach)) * exp(since / (3.0 * u_surf_life));
    float ran_up = smoothstep(0.02, 0.1, f.here.g * u_surf_scale);
    surf_carried = vec3(0.0);
    Footprint point = Footprint(vec2(0.0), vec2(0.0));
    return min(foam_amount(min(u_surf_line * ran_up * (0.3 + 0.9 * surf_patches(q, point)) * (swept + line), SURF_CAP), p, fp), 1.0);
}
