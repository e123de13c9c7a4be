// Foam from what the flow gathers.

// @part map
// Foam that drifts, read from its map: f = amount * sum of the generations' patches, in [0, DRIFT_CAP].
uniform sampler2D u_drift_map;
uniform sampler2D u_drift_coarse;

// Sum of so many places from uv on. Counted, so that drivers without branches read no map that has no weight. By the sampler: its 256
// steps between texels are finer than what a mask's threshold tells apart.
vec4 drift_places(sampler2D map, vec2 uv, vec2 next, int count) {
    vec4 sum = vec4(0.0);
    for (int i = 0; i < count; ++i) {
        sum += textureLod(map, uv + float(i) * next, 0.0);
    }
    return sum;
}

float drift_saturation(vec2 p, float height, Footprint fp) {
    vec2 q = p + u_drift_place;
    float rim = drift_rim(q);
    if (rim == 0.0) {
        return 0.0;
    }
    vec4 found = vec4(0.0);
    if (SURFACE_FILTER) {
        // Four places along the footprint, each from the map whose texels are nearer its breadth or the way between them.
        float first = dot(fp.x, fp.x);
        float second = dot(fp.y, fp.y);
        vec2 along = first > second ? fp.x : fp.y;
        float reach = sqrt(max(min(first, second), 0.0625 * max(first, second)));
        float coarse = smoothstep(0.0, 2.0, log2(max(reach * float(DRIFT_SIZE) / (2.0 * u_drift_half), 1e-3)));
        vec2 uv = 0.5 + 0.5 * (q - 0.375 * along) / u_drift_half;
        vec2 next = 0.125 / u_drift_half * along;
        vec4 fine = drift_places(u_drift_map, uv, next, coarse < 1.0 ? 4 : 0);
        found = 0.25 * mix(fine, drift_places(u_drift_coarse, uv, next, coarse > 0.0 ? 4 : 0), coarse);
    } else {
        found = textureLod(u_drift_map, 0.5 + 0.5 * q / u_drift_half, 0.0);
    }
    return min(u_drift_foam * rim * dot(found, drift_shares()), DRIFT_CAP);
}

// @part rim
// Drifting foam thins out toward the rim of the circle in its square, over the last two fifths of the radius.
uniform vec2 u_drift_place; // from the square's middle to the eye, m
uniform float u_drift_foam; // saturation of a patch

float drift_rim(vec2 q) {
    return 1.0 - smoothstep(0.6, 1.0, length(q) / u_drift_half);
}

// @part exact
// Foam that drifts, gone back for at each sample: f = amount * sum of the generations' patches, in [0, DRIFT_CAP].
float drift_saturation(vec2 p, float height, Footprint fp) {
    vec2 q = p + u_drift_place;
    float rim = drift_rim(q);
    if (rim == 0.0) {
        return 0.0;
    }
    vec4 shares = drift_shares();
    float sum = 0.0;
    for (int j = 0; j < DRIFT_GENERATIONS; ++j) {
        q = drift_origin(q, j);
        sum += shares[j] * drift_patch(drift_generation(j), q);
    }
    return min(u_drift_foam * rim * sum, DRIFT_CAP);
}
