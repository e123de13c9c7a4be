// The area-correct threshold: share of the footprint where s exceeds the mask's B-spline, from a smooth edge on it when magnified,
// from texels that hold where their thresholds lie when small. docs/formulae.md, section 5. s in [0, 1]; exact at 0 and 1.
uniform sampler2D u_mask_quantiles; // row 0: of the B-spline; row 1 + level: of a level's texels
uniform sampler2D u_mask_spans;    // a texel's thresholds lie evenly from .r on, over a width of 1 / .g
uniform float u_foam_fade;         // width of the ramp, in shares of the plane
uniform float u_foam_texture_share;

// Where to threshold so that a share s is covered. Table entries crowd toward s = 0 and 1, where the quantiles bend most.
float quantile(float s, int row) {
    float held = clamp(s, 0.0, 1.0);
    float x = (held <= 0.5 ? sqrt(0.5 * held) : 1.0 - sqrt(0.5 - 0.5 * held)) * float(QUANTILES - 1);
    int i = min(int(x), QUANTILES - 2);
    return mix(texelFetch(u_mask_quantiles, ivec2(i, row), 0).r, texelFetch(u_mask_quantiles, ivec2(i + 1, row), 0).r, x - float(i));
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
float ramp_integral(float x, float fade) {
    float rising = clamp(x, 0.0, fade);
    // A fade below the least normal float counts as 0 where such floats do: 0/0.
    return rising * rising / max(2.0 * fade, 1e-30) + max(x - fade, 0.0);
}

// Mean of the ramp over thresholds that lie evenly from low on, over a width of 1 / slope.
float ramp_mean(float threshold, float low, float slope, float fade) {
    if (!FOAM_FADES) {
        return clamp((threshold - low) * slope, 0.0, 1.0);
    }
    float above = threshold - low;
    return (ramp_integral(above, fade) - ramp_integral(above - 1.0 / slope, fade)) * slope;
}

// Shares of the texels about -1, 0, 1 and 2 of a box `width` texels wide about t; of two texels the middle ones.
vec4 box_shares(float t, float width) {
    vec4 edge = vec4(-1.5, -0.5, 0.5, 1.5);
    vec4 share = clamp(t + 0.5 * width - edge, 0.0, 1.0) - clamp(t - 0.5 * width - edge, 0.0, 1.0);
    return FOAM_SIDE == 4 ? share / width : vec4(0.0, share.yz / (share.y + share.z), 0.0);
}

// From FOAM_SIDE by FOAM_SIDE texels of a level. size: sides of the footprint, texels of that level.
float level_coverage(float s, vec2 uv, vec2 size, int level) {
    int texels = MASK_SIZE >> level;
    vec2 at = fract(uv) * float(texels) - 0.5;
    vec2 base = floor(at);
    vec2 width = clamp(size, 1e-2, 0.75 * float(FOAM_SIDE));
    vec4 across = box_shares(at.x - base.x, width.x);
    vec4 down = box_shares(at.y - base.y, width.y);
    float threshold = quantile(s, 1 + level);
    float sum = 0.0;
    for (int j = 2 - FOAM_SIDE / 2; j < 2 + FOAM_SIDE / 2; ++j) {
        float row = 0.0;
        for (int i = 2 - FOAM_SIDE / 2; i < 2 + FOAM_SIDE / 2; ++i) {
            vec2 span = texelFetch(u_mask_spans, (ivec2(base) + ivec2(i - 1, j - 1)) & (texels - 1), level).rg;
            row += across[i] * ramp_mean(threshold, span.x, span.y, u_foam_fade);
        }
        sum += down[j] * row;
    }
    return sum;
}

// From the finest level whose texels hold the footprint, led over to the next where they hardly do.
float minified_coverage(float s, vec2 uv, vec2 size) {
    float most = max(size.x, size.y) * (8.0 / (3.0 * float(FOAM_SIDE)));
    float held = clamp(most, 1.0, float(1 << (MASK_LEVELS - 1)));
    // Its binary exponent: no driver's logarithm decides on the level.
    int level = (floatBitsToInt(held) >> 23) - 127;
    float scale = intBitsToFloat((127 - level) << 23);
    float next = smoothstep(1.75, 2.0, held * scale);
    int levels = next > 0.0 ? 2 : 1;
    float covered = 0.0;
    for (int i = 0; i < levels; ++i) {
        covered += (i == 0 ? 1.0 - next : next) * level_coverage(s, uv, scale * size, level + i);
        scale *= 0.5;
    }
    return covered;
}

float magnified_coverage(float s, vec2 uv, vec2 uv_x, vec2 uv_y) {
    vec2 spline = mask_spline(uv, uv_x, uv_y);
    float arm = max(spline.y, 5e-4);
    float threshold = quantile(s, 0);
    float fade = 0.0;
    if (FOAM_FADES) {
        // The ramp runs over shares of the plane; the spline crowds them together.
        float part = min(s, u_foam_fade);
        fade = (threshold - quantile(s - part, 0)) * u_foam_fade / max(part, 1e-30);
    }
    return ramp_mean(threshold, spline.x - arm, 0.5 / arm, fade);
}

float filtered_coverage(float s, vec2 uv, vec2 uv_x, vec2 uv_y) {
    // The sides of the box that has the footprint's variance along the mask's axes.
    vec2 size = float(MASK_SIZE) * sqrt(uv_x * uv_x + uv_y * uv_y);
    float far = smoothstep(1.0, 1.5, max(size.x, size.y));
    float covered = minified_coverage(s, uv, size);
    if (far < 1.0) {
        covered = mix(magnified_coverage(s, uv, uv_x, uv_y), covered, far);
    }
    covered *= smoothstep(0.0, 1.0 / 256.0, s);
    float share = FOAM_FADES ? covered : 1.0 - (1.0 - covered) * smoothstep(0.0, 1.0 / 256.0, 1.0 - s);
    // The quotient's rounding passes 1, and foam over glitter would turn negative.
    return clamp(share, 0.0, 1.0);
}

float foam_amount(float f, vec2 p, Footprint fp) {
    float s = clamp(f, 0.0, 1.0);
    float covered = filtered_coverage(s, mask_uv(p), mask_turn(fp.x), mask_turn(fp.y));
    return FOAM_TEXTURED ? covered * mix(1.0, foam_texture(p, fp), u_foam_texture_share) : covered;
}
