// From where the water was whole quarters of a generation ago (foam/drift/still_pass.glsl) to where it was when its generation came up.
int drift_part() {
    return clamp(int(u_drift_clock.y * (float(DRIFT_PARTS) / DRIFT_GENERATION)), 0, DRIFT_PARTS - 1);
}

ivec2 drift_still_texel() {
    return ivec2(gl_FragCoord.xy) + ivec2(0, drift_part() * DRIFT_SIZE);
}

vec2 drift_rest(vec2 still) {
    return drift_ago(still, max(u_drift_clock.y - float(drift_part()) * (DRIFT_GENERATION / float(DRIFT_PARTS)), 0.0));
}
