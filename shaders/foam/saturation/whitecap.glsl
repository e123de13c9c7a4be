// Foam of crests that fold, now and some time ago.

// @part now
// Divergence of the moment alone.
float whitecap_saturation(vec2 p, float height, Footprint fp) {
    vec4 seen = FOLD_SHARED ? sea_shaded : sea_resolved(p, fp);
    float f = u_whitecap_share[0] * fold_ramp(seen.w, sqrt(u_whitecap_variance.x * seen.z), u_whitecap[0]);
    return fold_together(f, seen.z);
}

// @part old
// Foam of long ago, from its map and the levels of means below it.
uniform sampler2D u_old_foam;

float fold_old(vec2 p, Footprint fp) {
    // Its texels lie twice as far apart as the sea's.
    float level = SURFACE_FILTER ? max(sea_level(u_sea_size_0, fp) - 1.0, 0.0) : 0.0;
    return textureLod(u_old_foam, sea_place_0(p) + 0.5 / float(AGE_SIZE), level).r;
}

// @part no_old
// Foam does not last.
float fold_old(vec2 p, Footprint fp) {
    return 0.0;
}

// @part whitecap
// Foam where the sea folds, now and within the last seconds: f = sum of a_j clamp((threshold - F_j) / width, 0, 1), at most 1.
// F = l div D, the divergence of the displacement: the Jacobian less 1 to first order. What the footprint does not resolve of it is taken
// as normal. docs/formulae.md, section 4.
uniform vec2 u_whitecap[2];         // threshold and width, now and earlier
uniform vec3 u_whitecap_variance;   // of the divergence, a mean square slope's worth, now and earlier; and the whole mean square slope
uniform float u_whitecap_clamped;   // share of summed foam that is left where sums are held at 1
uniform float u_whitecap_share[FOLD_TIMES]; // of the foam of each time that is left

// Mean of max(t - n, 0) over normal n of deviation s. The error function of Abramowitz and Stegun 7.1.26, to 1.5e-7.
float fold_above(float t, float s) {
    float x = clamp(t / s, -6.0, 6.0);
    float y = abs(x) * 0.707106781186548;
    float q = 1.0 / (1.0 + 0.3275911 * y);
    float bell = exp(-y * y);
    float tail = 0.5 * bell * q * (0.254829592 + q * (-0.284496736 + q * (1.421413741 + q * (-1.453152027 + q * 1.061405429))));
    float share = x < 0.0 ? tail : 1.0 - tail;
    return s * 0.398942280401433 * bell + (t / s > 6.0 ? t : s * x * share);
}

float fold_ramp(float divergence, float deviation, vec2 limits) {
    float over = limits.x - divergence;
    if (deviation < 0.02 * limits.y) {
        return clamp(over / limits.y, 0.0, 1.0);
    }
    return clamp((fold_above(over, deviation) - fold_above(over - limits.y, deviation)) / limits.y, 0.0, 1.0);
}

// Foam of all times together. Means over a footprint are not held at 1 one by one, so what that would take goes by its share.
float fold_together(float f, float unresolved) {
    return min(f * mix(1.0, u_whitecap_clamped, min(unresolved / u_whitecap_variance.z, 1.0)), 1.0);
}

// @part four
// Divergence at four earlier times on two tiles.
uniform sampler2D u_age_tiles; // four times of the first tile over those of the second, a row between

float whitecap_saturation(vec2 p, float height, Footprint fp) {
    vec4 seen = FOLD_SHARED ? sea_shaded : sea_resolved(p, fp);
    // The earlier divergence has no means of its own: of it the footprint resolves as much as of the present one.
    float kept = sqrt(max(1.0 - seen.z / u_whitecap_variance.z, 0.0));
    float f = u_whitecap_share[0] * fold_ramp(seen.w, sqrt(u_whitecap_variance.x * seen.z), u_whitecap[0]);
    float deviation = sqrt(u_whitecap_variance.y * seen.z);
    vec4 then = kept * (sea_fetch_four(u_age_tiles, sea_place_0(p), 0)
        + sea_fetch_four(u_age_tiles, sea_place_1(p), 1));
    for (int j = 0; j < 4; ++j) {
        f += u_whitecap_share[1 + j] * fold_ramp(then[j], deviation, u_whitecap[1]);
    }
    return fold_together(f + fold_old(p, fp), seen.z);
}

// @part eight
// Divergence at eight earlier times on two tiles.
uniform sampler2D u_age_tiles; // four times over the next four, then those of the second tile, a row between

float whitecap_saturation(vec2 p, float height, Footprint fp) {
    vec4 seen = FOLD_SHARED ? sea_shaded : sea_resolved(p, fp);
    // The earlier divergence has no means of its own: of it the footprint resolves as much as of the present one.
    float kept = sqrt(max(1.0 - seen.z / u_whitecap_variance.z, 0.0));
    float f = u_whitecap_share[0] * fold_ramp(seen.w, sqrt(u_whitecap_variance.x * seen.z), u_whitecap[0]);
    float deviation = sqrt(u_whitecap_variance.y * seen.z);
    vec4 then = kept * (sea_fetch_four(u_age_tiles, sea_place_0(p), 0)
        + sea_fetch_four(u_age_tiles, sea_place_1(p), 2));
    for (int j = 0; j < 4; ++j) {
        f += u_whitecap_share[1 + j] * fold_ramp(then[j], deviation, u_whitecap[1]);
    }
    then = kept * (sea_fetch_four(u_age_tiles, sea_place_0(p), 1)
        + sea_fetch_four(u_age_tiles, sea_place_1(p), 3));
    for (int j = 0; j < 4; ++j) {
        f += u_whitecap_share[5 + j] * fold_ramp(then[j], deviation, u_whitecap[1]);
    }
    return fold_together(f + fold_old(p, fp), seen.z);
}
