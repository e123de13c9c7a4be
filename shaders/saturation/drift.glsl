// Foam that drifts, read from its map: f = amount * sum of the broods' patches, in [0, DRIFT_CAP].
uniform sampler2D u_drift_map;
uniform sampler2D u_drift_coarse;

float drift_saturation(vec2 p, float height, Footprint fp) {
    vec2 q = p + u_drift_place;
    float rim = drift_rim(q);
    if (rim == 0.0) {
        return 0.0;
    }
    vec4 found = vec4(0.0);
    if (SURFACE_FILTER) {
        // Four parts of the footprint, each from the map whose texels are nearer its size.
        float texels = sqrt(max(dot(fp.x, fp.x), dot(fp.y, fp.y))) * float(DRIFT_SIZE) / (4.0 * u_drift_half);
        float coarse = smoothstep(0.0, 2.0, log2(max(texels, 1e-3)));
        for (int i = 0; i < 4; ++i) {
            vec2 uv = 0.5 + 0.5 * (q + (float(i & 1) - 0.5) * 0.5 * fp.x + (float(i >> 1) - 0.5) * 0.5 * fp.y) / u_drift_half;
            found += 0.25 * mix(textureLod(u_drift_map, uv, 0.0), textureLod(u_drift_coarse, uv, 0.0), coarse);
        }
    } else {
        found = textureLod(u_drift_map, 0.5 + 0.5 * q / u_drift_half, 0.0);
    }
    return min(u_drift_foam * rim * dot(found, drift_shares()), DRIFT_CAP);
}
