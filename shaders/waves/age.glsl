// Earlier folds of the sea, from which foam is left.

// @part times
// Four earlier times for each of a block's.
uniform vec2 u_age_scale; // l 2 pi / side of the first and second tile, rad/m
uniform float u_age_step; // s
uniform float u_age_from; // s before the first of them
uniform vec4 u_age_drift; // of the foam, rad/s a wave along the first and second tile

// Seconds before now.
vec4 times_before(int time) {
    return u_age_from + u_age_step * (float(4 * time) + vec4(1.0, 2.0, 3.0, 4.0));
}

// @part gerstner_pass
// Divergence l div D of the waves, -l sum of a k cos(theta), at four earlier times.
vec4 water(ivec2 at, int tile, int time) {
    vec4 before = times_before(time);
    vec4 sum = vec4(0.0);
    ivec2 waves = gerstner_waves(tile);
    float scale = tile == 0 ? u_age_scale.x : u_age_scale.y;
    for (int i = waves.x; i < waves.y; ++i) {
        vec4 wave = u_gerstner[i];
        float theta = gerstner_theta(i, at, BLOCK_SIZE);
        float rate = wave.w;
        if (AGE_DRIFTS) {
            rate -= dot(wave.xy, tile == 0 ? u_age_drift.xy : u_age_drift.zw);
        }
        vec4 angle = theta + rate * before;
        sum -= scale * length(wave.xy) * wave.z
            * vec4(cos(wrap_phase(angle.x)), cos(wrap_phase(angle.y)), cos(wrap_phase(angle.z)), cos(wrap_phase(angle.w)));
    }
    return sum;
}

// @part spectrum_pass
// Spectra of the divergence F = l div D = -l |k| h at four earlier times: (F1 + i F2, F3 + i F4).

// Of the water that has drifted here since.
vec2 divergence_then(vec2 k, int tile, float before) {
    vec2 then = amplitude(as_int(k), tile, before);
    if (!AGE_DRIFTS) {
        return then;
    }
    float angle = -before * dot(k, tile == 0 ? u_age_drift.xy : u_age_drift.zw);
    return complex_product(then, vec2(cos(angle), sin(angle)));
}

vec4 spectra(vec2 k, int tile, int time) {
    float scale = -(tile == 0 ? u_age_scale.x : u_age_scale.y) * length(k);
    vec4 before = times_before(time);
    vec2 a = divergence_then(k, tile, before.x);
    vec2 b = divergence_then(k, tile, before.y);
    vec2 c = divergence_then(k, tile, before.z);
    vec2 d = divergence_then(k, tile, before.w);
    return scale * vec4(a.x - b.y, a.y + b.x, c.x - d.y, c.y + d.x);
}

// @part tile_pass
// Divergence at earlier times, carried to where their water is now: bilinear between texels, which lie twice as far apart as the sea's.
// Four times over the next four, a tile over the next; each with its first row once more at its end, so that bilinear reads need no wrap
// there.
uniform sampler2DArray u_age_folds;
uniform vec3 u_sea_other; // the second tile, as the first

void main() {
    float finer = float(SEA_DISPLACED) / float(AGE_SIZE);
    ivec2 at = as_int(floor(gl_FragCoord.xy));
    int row = at.y / (AGE_SIZE + 1);
    sea_block = row < AGE_ROWS ? u_sea_block : u_sea_other;
    at.y = (at.y - row * (AGE_SIZE + 1)) & (AGE_SIZE - 1);
    o_tile = block_between(u_age_folds, AGE_SIZE, row, resting(finer * vec2(at)) / finer);
}

// @part old_foam_pass
// Foam that the waves of the largest tile left at 16 times long ago, on the water that was there, where that water is now:
// sum of a_j clamp((threshold - F_j) / width, 0, 1). Divergence: four times over the next four, bilinear between texels.
uniform sampler2DArray u_old_folds;
uniform vec2 u_old_fold;     // threshold and width
uniform vec4 u_old_share[4]; // of the foam of each time that is left

void main() {
    float finer = float(SEA_DISPLACED) / float(AGE_SIZE);
    sea_block = u_sea_block;
    vec2 at = resting(finer * floor(gl_FragCoord.xy)) * (float(OLD_SIZE) / float(SEA_DISPLACED));
    float sum = 0.0;
    for (int row = 0; row < 4; ++row) {
        vec4 left = clamp((u_old_fold.x - block_between(u_old_folds, OLD_SIZE, row, at)) / u_old_fold.y, 0.0, 1.0);
        sum += dot(u_old_share[row], left);
    }
    o_tile = vec4(sum, 0.0, 0.0, 0.0);
}
