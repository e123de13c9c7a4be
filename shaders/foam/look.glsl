// Looks of foam: how much of a pixel is foam at a saturation (Yingst, Alford and Parberry 2011, and filtered).

// @part halftone
// Thresholded saturation (Yingst et al. 2011, equation 1).
float foam_amount(float f, vec2 p, Footprint fp) {
    return f > mask_threshold(p) ? 1.0 : 0.0;
}

// @part halftone_textured
// Thresholded, fading and textured (Yingst et al. 2011, equation 3).
float foam_amount(float f, vec2 p, Footprint fp) {
    float m = mask_threshold(p);
    return f > m ? clamp(0.5 * f - m, 0.0, 1.0) * foam_texture(p, fp) : 0.0;
}

// @part textured
// The traditional way: a foam texture faded by the saturation (Yingst et al. 2011, figure 7a).
float foam_amount(float f, vec2 p, Footprint fp) {
    return clamp(f, 0.0, 1.0) * foam_texture(p, fp);
}

// @part fading
// Thresholded saturation that fades before it pops (Yingst et al. 2011, equation 2).
float foam_amount(float f, vec2 p, Footprint fp) {
    float m = mask_threshold(p);
    return f > m ? clamp(0.5 * f - m, 0.0, 1.0) : 0.0;
}

// @part listing
// The code that the paper prints (Yingst et al. 2011, "Applying the Mask"); it differs from its equation 3.
float foam_amount(float f, vec2 p, Footprint fp) {
    float m = mask_threshold(p);
    return f > m ? clamp(f - m, 0.15, 3.0) * foam_texture(p, fp) : 0.0;
}

// @part filtered
// The area-correct threshold: share of the footprint where s exceeds the mask's B-spline, from a smooth edge on it when magnified,
// from texels that hold where their thresholds lie when small. docs/formulae.md, section 5. s in [0, 1]; exact at 0 and 1.
// With octaves the threshold leaves a ramp, and the mask, turned and five times finer, is a threshold of what the ramp left.
uniform usampler2D u_mask_atlas;    // the mask, its levels below one another beside it; a fetch gets four texels, from the one before on
uniform sampler2D u_mask_quantiles; // an entry and the next; row 0: of the B-spline; row 1 + level: of a level's texels
                                    // with octaves of their ramps, and the last row has the ramp's width over the B-spline
uniform float u_foam_fade;          // width of the ramp, in shares of the plane
uniform float u_foam_texture_share;

// Which of the masks that lie over one another, how many octaves of it, and the share of the next mask, over this one; 0: it is not asked.
int foam_mask = 0;
int foam_octaves = 4;
float foam_older = 0.0;

// Where to threshold so that a share s is covered. Table entries crowd toward s = 0 and 1, where the quantiles bend most.
float quantile(float s, int row) {
    float held = clamp(s, 0.0, 1.0);
    float root = sqrt(0.5 * min(held, 1.0 - held));
    float x = (held <= 0.5 ? root : 1.0 - root) * float(QUANTILES - 1);
    float node = min(floor(x), float(QUANTILES - 2));
    vec2 entry = texel_at(u_mask_quantiles, ivec2(as_int(node), foam_mask * MASK_ROWS + row)).rg;
    return mix(entry.x, entry.y, x - node);
}

// Integral of the ramp clamp(x / fade, 0, 1).
vec4 ramp_integral(vec4 x, float fade) {
    vec4 rising = clamp(x, 0.0, fade);
    // A fade below the least normal float counts as 0 where such floats do: 0/0.
    return rising * rising * (1.0 / max(2.0 * fade, 1e-30)) + max(x - fade, 0.0);
}

// Mean of the ramp over thresholds that lie evenly over a width, the lowest of them `above` under the threshold.
vec4 ramp_mean(vec4 above, vec4 width, float fade) {
    if (!FOAM_FADES && FOAM_OCTAVES == 1) {
        return clamp(above / width, 0.0, 1.0);
    }
    return (ramp_integral(above, fade) - ramp_integral(above - width, fade)) / width;
}

vec4 row_thresholds(uvec2 row) {
    return vec4(row.x & 65535u, row.x >> 16u, row.y & 65535u, row.y >> 16u);
}

// Sums of a row of the mask by the spline's weights, its slopes and its bends.
vec3 spline_row(uvec2 row, float t) {
    vec4 m = row_thresholds(row);
    return vec3(dot(spline_weights(t), m), dot(spline_slopes(t), m), dot(spline_bends(t), m));
}

// From the mask's uniform cubic B-spline: its mean over the footprint, to second order, and its change across it. Rows of the mask, in
// steps of 1/65536 that end half a step higher, each summed before the next: all at once would not fit in GPUs' registers.
// t: place between the middle texels.
float magnified_coverage(float s, float threshold, uvec2 a, uvec2 b, uvec2 c, uvec2 d, vec2 t, vec2 uv_x, vec2 uv_y) {
    vec3 first = spline_row(a, t.x);
    vec3 second = spline_row(b, t.x);
    vec3 third = spline_row(c, t.x);
    vec3 fourth = spline_row(d, t.x);
    vec4 along = vec4(first.x, second.x, third.x, fourth.x);
    vec4 across = vec4(first.y, second.y, third.y, fourth.y);
    vec4 wy = spline_weights(t.y);
    vec4 sy = spline_slopes(t.y);
    vec2 slope = vec2(dot(across, wy), dot(along, sy));
    vec3 bend = vec3(dot(vec4(first.z, second.z, third.z, fourth.z), wy), dot(along, spline_bends(t.y)), dot(across, sy));
    vec2 x = uv_x * float(MASK_SIZE);
    vec2 y = uv_y * float(MASK_SIZE);
    float curvature = bend.x * (x.x * x.x + y.x * y.x) + bend.y * (x.y * x.y + y.y * y.y) + 2.0 * bend.z * (x.x * x.y + y.x * y.y);
    float mean = (dot(along, wy) + curvature / 24.0 + 0.5) / 65536.0;
    float arm = max(length(vec2(dot(slope, x), dot(slope, y))) / 131072.0, 5e-4);
    float fade = 0.0;
    if (FOAM_OCTAVES > 1) {
        fade = quantile(s, 1 + MASK_LEVELS);
    } else if (FOAM_FADES) {
        // The ramp runs over shares of the plane; the spline crowds them together.
        float part = min(s, u_foam_fade);
        fade = (threshold - quantile(s - part, 0)) * u_foam_fade / max(part, 1e-30);
    }
    return ramp_mean(vec4(threshold - mean + arm), vec4(2.0 * arm), fade).x;
}

// Shares of the texels about -1, 0, 1 and 2 of a box `width` texels wide about t; of two texels the middle ones.
vec4 box_shares(float t, float width) {
    vec4 edge = vec4(-1.5, -0.5, 0.5, 1.5);
    vec4 share = clamp(t + 0.5 * width - edge, 0.0, 1.0) - clamp(t - 0.5 * width - edge, 0.0, 1.0);
    return FOAM_SIDE == 4 ? share / width : vec4(0.0, share.yz / (share.y + share.z), 0.0);
}

// Of four texels of a row, in 256ths: where their thresholds begin, and over how much they lie.
vec4 row_coverage(uvec2 row, float threshold) {
    uvec4 four = uvec4(row.x, row.x >> 16u, row.y, row.y >> 16u);
    vec4 low = vec4(four & 255u);
    float fade = FOAM_OCTAVES > 1 ? OCTAVE_RAMP : u_foam_fade;
    return ramp_mean(256.0 * threshold - low, vec4(((four >> 8u) & 255u) + 1u), 256.0 * fade);
}

// From 16 texels round the footprint: form -1 of the mask itself, form 0 and on of a level. size: its sides, texels of the mask.
float form_coverage(float s, vec2 uv, vec2 uv_x, vec2 uv_y, vec2 size, int form) {
    int level = max(form, 0);
    int texels = MASK_SIZE >> level;
    vec2 at = fract(uv) * float(texels) - 0.5;
    vec2 low = floor(at);
    ivec2 base = as_bits(low);
    vec2 t = at - low;
    ivec2 corner = form < 0 ? ivec2(0) : level > 0 ? ivec2(2 * MASK_SIZE, MASK_SIZE - 2 * texels) : ivec2(MASK_SIZE, 0);
    corner.y += foam_mask * MASK_SIZE;
    int last = texels - 1;
    int column = corner.x + (base.x & last);
    uvec2 a = texel_at(u_mask_atlas, ivec2(column, corner.y + ((base.y - 1) & last))).rg;
    uvec2 b = texel_at(u_mask_atlas, ivec2(column, corner.y + (base.y & last))).rg;
    uvec2 c = texel_at(u_mask_atlas, ivec2(column, corner.y + ((base.y + 1) & last))).rg;
    uvec2 d = texel_at(u_mask_atlas, ivec2(column, corner.y + ((base.y + 2) & last))).rg;
    float threshold = quantile(s, 1 + form);
    if (form < 0) {
        return magnified_coverage(s, threshold, a, b, c, d, t, uv_x, uv_y);
    }
    vec2 width = clamp(size * intBitsToFloat((127 - level) << 23), 1e-2, 0.75 * float(FOAM_SIDE));
    vec4 across = box_shares(t.x, width.x);
    vec4 down = box_shares(t.y, width.y);
    float middle = down.y * dot(across, row_coverage(b, threshold)) + down.z * dot(across, row_coverage(c, threshold));
    if (FOAM_SIDE == 2) {
        return middle;
    }
    return down.x * dot(across, row_coverage(a, threshold)) + middle + down.w * dot(across, row_coverage(d, threshold));
}

// The Gaussian integer 4 + 3i: five times finer and turned by 37 degrees, and of whole numbers, so that the tile maps onto itself.
vec2 octave(vec2 uv) {
    return vec2(4.0 * uv.x - 3.0 * uv.y, 3.0 * uv.x + 4.0 * uv.y);
}

// What each octave's ramp leaves grey is thresholded by the next, as far as the footprint shows it; all and none stay. Where two masks
// meet each thins its foam, and what neither covers stays free (foam/cover.glsl). whole: the amount where all is covered.
float filtered_coverage(float s, float whole, vec2 uv, vec2 uv_x, vec2 uv_y) {
    Footprint tiles = Footprint(uv_x, uv_y);
    vec2 place = uv;
    float free = 1.0;
    float covered = 0.0;
    float second = 0.0;
    int asked = min(foam_octaves, FOAM_OCTAVES);
    int octaves = asked;
    // One loop for masks, octaves and both forms of each, asked at the end: drivers without branches would run one that asks first
    // once more, for nothing, and of loops in loops GPUs would hold half as many waves.
    do {
        // The sides of the box that has the footprint's variance along the mask's axes.
        vec2 size = float(MASK_SIZE) * sqrt(uv_x * uv_x + uv_y * uv_y);
        float most = max(size.x, size.y) * (8.0 / (3.0 * float(FOAM_SIDE)));
        float held = clamp(most, 1.0, float(1 << (MASK_LEVELS - 1)));
        // The finest level whose texels hold the footprint, led over to the next where they hardly do: the binary exponent, so that
        // no driver's logarithm decides on it.
        int form = (floatBitsToInt(held) >> 23) - 127;
        float next = smoothstep(1.75, 2.0, held * intBitsToFloat((127 - form) << 23));
        if (most < 1.0) {
            form = -1;
            next = smoothstep(2.0 / 3.0, 1.0, most);
        }
        bool first = second == 0.0;
        covered += (first ? 1.0 - next : next) * form_coverage(s, uv, uv_x, uv_y, size, first ? form : form + 1);
        // Where nothing is covered the other form does not change that.
        second = first && s > 0.0 ? next : 0.0;
        if (second == 0.0) {
            covered *= smoothstep(0.0, 1.0 / 256.0, s);
            float share = FOAM_FADES && FOAM_OCTAVES == 1 ? covered : 1.0 - (1.0 - covered) * smoothstep(0.0, 1.0 / 256.0, 1.0 - s);
            // The quotient's rounding passes 1, and foam over glitter would turn negative.
            share = clamp(share, 0.0, 1.0);
            float shown = octaves == asked ? 1.0 : 1.0 - smoothstep(32.0, 64.0, max(size.x, size.y));
            s = FOAM_OCTAVES > 1 ? s + shown * (share - s) : share;
            covered = 0.0;
            uv = octave(fract(uv));
            uv_x = octave(uv_x);
            uv_y = octave(uv_y);
            // The longer side is at least the diagonal over the root of 2: from 64 texels on nothing of the next octave shows.
            bool seen = dot(uv_x, uv_x) + dot(uv_y, uv_y) < 8192.0 / float(MASK_SIZE * MASK_SIZE);
            octaves = seen && s > 0.0 && s < 1.0 ? octaves - 1 : 0;
            if (FOAM_MASKS > 1 && octaves == 0) {
                free *= 1.0 - s * whole;
                if (foam_older > 0.0) {
                    s = foam_older;
                    foam_older = 0.0;
                    foam_mask += 1;
                    octaves = asked;
                    uv = place;
                    uv_x = tiles.x;
                    uv_y = tiles.y;
                }
            }
        }
    } while (octaves > 0);
    return FOAM_MASKS > 1 ? 1.0 - free : s * whole;
}

// What a saturation covers in the mean: as much as the fading look shows.
float foam_share(float f) {
    float s = clamp(f, 0.0, 1.0);
    return FOAM_OCTAVES > 1 ? ramp_integral(vec4(s), u_foam_fade).x : s;
}

// f: the saturation, or where foam lives the share.
float foam_amount(float f, vec2 p, Footprint fp) {
    float whole = FOAM_TEXTURED ? mix(1.0, foam_texture(p, fp), u_foam_texture_share) : 1.0;
    return filtered_coverage(FOAM_LIVES ? f : foam_share(f), whole, mask_uv(p), mask_turn(fp.x), mask_turn(fp.y));
}
