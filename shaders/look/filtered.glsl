// The area-correct threshold: share of the footprint where s exceeds the mask, from the mask's distribution when small, from
// a smooth edge on its B-spline when magnified. docs/formulae.md, section 5. s in [0, 1]; exact at 0 and 1.
uniform sampler2D u_mask_quantiles;
uniform float u_foam_fade;         // width of the ramp, in thresholds
uniform float u_foam_texture_share;

// Table entries crowd toward s = 0 and 1, where the quantiles bend most.
float quantile(float s) {
    float held = clamp(s, 0.0, 1.0);
    float x = (held <= 0.5 ? sqrt(0.5 * held) : 1.0 - sqrt(0.5 - 0.5 * held)) * float(QUANTILES - 1);
    int i = min(int(x), QUANTILES - 2);
    return mix(texelFetch(u_mask_quantiles, ivec2(i, 0), 0).r, texelFetch(u_mask_quantiles, ivec2(i + 1, 0), 0).r, x - float(i));
}

vec4 spline_weights(float t) {
    float u = 1.0 - t;
    return vec4(u * u * u, (3.0 * t - 6.0) * t * t + 4.0, (3.0 * u - 6.0) * u * u + 4.0, t * t * t) / 6.0;
}

vec4 spline_slopes(float t) {
    float u = 1.0 - t;
    return 0.5 * vec4(-u * u, (3.0 * t - 4.0) * t, (4.0 - 3.0 * u) * u, t * t);
}

vec4 spline_bends(float t) {
    float u = 1.0 - t;
    return vec4(u, 3.0 * t - 2.0, 3.0 * u - 2.0, t);
}

// Mean of the mask's uniform cubic B-spline over the footprint, to second order, and half its change across it.
vec2 mask_spline(vec2 uv, vec2 uv_x, vec2 uv_y) {
    vec2 at = fract(uv) * float(MASK_SIZE) - 0.5;
    vec2 base = floor(at);
    vec4 wx = spline_weights(at.x - base.x);
    vec4 wy = spline_weights(at.y - base.y);
    vec4 sx = spline_slopes(at.x - base.x);
    vec4 sy = spline_slopes(at.y - base.y);
    vec4 bx = spline_bends(at.x - base.x);
    vec4 by = spline_bends(at.y - base.y);
    vec3 sum = vec3(0.0);
    vec3 bend = vec3(0.0);
    for (int j = 0; j < 4; ++j) {
        ivec2 row = ivec2(base) + ivec2(-1, j - 1);
        vec4 m = vec4(mask_texel(row), mask_texel(row + ivec2(1, 0)), mask_texel(row + ivec2(2, 0)), mask_texel(row + ivec2(3, 0)));
        float along = dot(wx, m);
        float across = dot(sx, m);
        sum += vec3(wy[j] * along, wy[j] * across, sy[j] * along);
        bend += vec3(wy[j] * dot(bx, m), by[j] * along, sy[j] * across);
    }
    vec2 x = uv_x * float(MASK_SIZE);
    vec2 y = uv_y * float(MASK_SIZE);
    float curvature = bend.x * (x.x * x.x + y.x * y.x) + bend.y * (x.y * x.y + y.y * y.y) + 2.0 * bend.z * (x.x * x.y + y.x * y.y);
    return vec2(sum.x + curvature / 24.0, 0.5 * length(vec2(dot(sum.yz, x), dot(sum.yz, y))));
}

// Integral of the ramp clamp(x / fade, 0, 1).
float ramp_integral(float x) {
    if (!FOAM_FADES) {
        return max(x, 0.0);
    }
    float rising = clamp(x, 0.0, u_foam_fade);
    // A fade below the least normal float counts as 0 where such floats do: 0/0.
    return rising * rising / max(2.0 * u_foam_fade, 1e-30) + max(x - u_foam_fade, 0.0);
}

float filtered_coverage(float s, vec2 uv, vec2 uv_x, vec2 uv_y) {
    float texels = float(MASK_SIZE) * sqrt(max(dot(uv_x, uv_x), dot(uv_y, uv_y)));
    float level = log2(max(texels, 1e-9));
    float far = smoothstep(-1.0, 0.0, level);
    vec2 moments = mask_moments(uv, max(level, 0.0));
    float deviation = sqrt(max(moments.y - moments.x * moments.x, 0.0));
    float threshold = moments.x;
    float saturation_here = s;
    float edge = 0.0;
    if (far < 1.0) {
        vec2 spline = mask_spline(uv, uv_x, uv_y);
        edge = spline.y * (1.0 - far);
        threshold = mix(spline.x, threshold, far);
        saturation_here = mix(quantile(s), s, far);
    }
    float arm = max(max(1.73205080756888 * deviation * far, edge), 5e-4);
    float above = saturation_here - threshold;
    float covered = (ramp_integral(above + arm) - ramp_integral(above - arm)) / (2.0 * arm);
    covered *= smoothstep(0.0, 1.0 / 256.0, s);
    float share = FOAM_FADES ? covered : 1.0 - (1.0 - covered) * smoothstep(0.0, 1.0 / 256.0, 1.0 - s);
    // The quotient's rounding passes 1, and foam over glitter would turn negative.
    return clamp(share, 0.0, 1.0);
}

// The footprint whole, or its four quarters, each with its own part of the mask.
float mean_coverage(float s, vec2 uv, vec2 uv_x, vec2 uv_y) {
    if (FOAM_TAPS == 1) {
        return filtered_coverage(s, uv, uv_x, uv_y);
    }
    float sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec2 quarter = vec2(float(i & 1), float(i >> 1)) * 0.5 - 0.25;
        sum += filtered_coverage(s, uv + quarter.x * uv_x + quarter.y * uv_y, 0.5 * uv_x, 0.5 * uv_y);
    }
    return 0.25 * sum;
}

float foam_amount(float f, vec2 p, Footprint fp) {
    float s = clamp(f, 0.0, 1.0);
    float covered = mean_coverage(s, mask_uv(p), mask_turn(fp.x), mask_turn(fp.y));
    return FOAM_TEXTURED ? covered * mix(1.0, foam_texture(p, fp), u_foam_texture_share) : covered;
}
