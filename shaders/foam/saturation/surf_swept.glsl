// Foam that the swash leaves on the sand: on all that it swept, thinning as on the water, and a line where it turned, which lasts longer.
// docs/formulae.md, section 8.
uniform float u_surf_line;

// What is left of both after -since periods.
float swept_left(vec2 born, float since) {
    return min(dot(born, exp(since / (vec2(1.0, 3.0) * u_surf_life))), SURF_CAP);
}

float surf_swept(ShoreField f, float ground, float patches, Footprint fp) {
    if (!SURF_LINED) {
        return 0.0;
    }
    // How high the ground is, in heights of the wave that runs up it.
    float reach = ground / max(f.here.g, 1e-3);
    if (reach >= 1.05) {
        return 0.0;
    }
    float since = shore_turn(f.here.r) - 1.0;
    float swept = 1.0 - smoothstep(0.85, 1.0, reach);
    float line = smoothstep(0.55, 0.9, reach) * (1.0 - smoothstep(0.95, 1.05, reach));
    float ran_up = smoothstep(0.02, 0.1, f.here.g * u_surf_scale);
    vec2 born = u_surf_line * ran_up * (0.3 + 0.9 * patches) * vec2(swept, line);
    float left = swept_left(born, since);
    if (!SURF_FILTERED) {
        return left;
    }
    // Where a wave's end goes through the footprint, some of it was swept a moment ago and some a period ago.
    vec2 out_to_sea = vec2(f.along_x.r, f.along_z.r);
    float width = clamp(abs(dot(out_to_sea, fp.x)) + abs(dot(out_to_sea, fp.y)), 1e-5, 1.0);
    bool late = since < -0.5;
    float share = max(0.5 - (late ? since + 1.0 : -since) / width, 0.0);
    return mix(left, swept_left(born, late ? 0.0 : -1.0), share);
}
