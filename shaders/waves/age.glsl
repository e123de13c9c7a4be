// Earlier folds of the sea, from which foam is left.

// @part gerstner_pass
// Divergence l div D of the waves, -l sum of a k cos(theta), at four earlier times; each four times a row of blocks.
uniform vec2 u_age_scale; // l 2 pi / side, rad/m
uniform float u_age_step; // s
uniform float u_age_from; // s before the first of them
uniform vec4 u_age_drift; // of the foam, rad/s a wave along the first and second tile
out vec4 o_divergence;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 before = u_age_from + u_age_step * (float(at.y / AGE_SIZE * 4) + vec4(1.0, 2.0, 3.0, 4.0));
    o_divergence = vec4(0.0);
    ivec2 waves = gerstner_waves(at.x / AGE_SIZE);
    float scale = at.x < AGE_SIZE ? u_age_scale.x : u_age_scale.y;
    for (int i = waves.x; i < waves.y; ++i) {
        vec4 wave = u_gerstner[i];
        float theta = gerstner_theta(i, at % AGE_SIZE, AGE_SIZE);
        float rate = wave.w;
        if (AGE_DRIFTS) {
            rate -= dot(wave.xy, at.x < AGE_SIZE ? u_age_drift.xy : u_age_drift.zw);
        }
        vec4 angle = theta + rate * before;
        o_divergence -= scale * length(wave.xy) * wave.z
            * vec4(cos(wrap_phase(angle.x)), cos(wrap_phase(angle.y)), cos(wrap_phase(angle.z)), cos(wrap_phase(angle.w)));
    }
}

// @part spectrum_pass
// Spectra of the divergence F = l div D = -l |k| h at four earlier times: (F1 + i F2, F3 + i F4). Tiles side by side, each
// four times a row of blocks.
uniform vec2 u_age_scale; // l 2 pi / side of the first and second tile, rad/m
uniform float u_age_step; // s
uniform float u_age_from; // s before the first of them
uniform vec4 u_age_drift; // of the foam, rad/s a wave along the first and second tile
out vec4 o_spectra;

// Of the water that has drifted here since.
vec2 divergence_then(ivec2 k, int tile, float before) {
    vec2 then = amplitude(k, tile, before);
    if (!AGE_DRIFTS) {
        return then;
    }
    float angle = -before * dot(vec2(k), tile == 0 ? u_age_drift.xy : u_age_drift.zw);
    return complex_product(then, vec2(cos(angle), sin(angle)));
}

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    int tile = at.x / AGE_SIZE;
    int rows = spectrum_rows(AGE_SIZE);
    ivec2 k;
    o_spectra = vec4(0.0);
    if (wave_of(ivec2(at.x % AGE_SIZE, at.y % rows), AGE_SIZE, k)) {
        float scale = -(tile == 0 ? u_age_scale.x : u_age_scale.y) * length(vec2(k));
        float first = float(at.y / rows * 4);
        vec2 a = divergence_then(k, tile, u_age_from + (first + 1.0) * u_age_step);
        vec2 b = divergence_then(k, tile, u_age_from + (first + 2.0) * u_age_step);
        vec2 c = divergence_then(k, tile, u_age_from + (first + 3.0) * u_age_step);
        vec2 d = divergence_then(k, tile, u_age_from + (first + 4.0) * u_age_step);
        o_spectra = scale * vec4(a.x - b.y, a.y + b.x, c.x - d.y, c.y + d.x);
    }
}

// @part tile_pass
// Divergence at earlier times, carried to where their water is now: bilinear between texels, which lie twice as far apart as the sea's.
// Four times over the next four, a tile over the next; each with its first row once more at its end, so that bilinear reads need no wrap
// there.
uniform sampler2D u_age_folds;
uniform vec3 u_sea_other; // the second tile, as the first

void main() {
    float finer = float(SEA_DISPLACED) / float(AGE_SIZE);
    ivec2 at = ivec2(gl_FragCoord.xy);
    int row = at.y / (AGE_SIZE + 1);
    sea_block = row < AGE_ROWS ? u_sea_block : u_sea_other;
    int tile = int(sea_block.x);
    at.y = (at.y - row * (AGE_SIZE + 1)) & (AGE_SIZE - 1);
    row -= tile * AGE_ROWS;
    o_tile = bilinear_wrapped(u_age_folds, ivec2(tile, row) * AGE_SIZE, AGE_SIZE, resting(finer * vec2(at)) / finer);
}

// @part old_foam_pass
// Foam that the waves of the largest tile left at 16 times long ago, on the water that was there, where that water is now:
// sum of a_j clamp((threshold - F_j) / width, 0, 1). Divergence: four times over the next four, bilinear between texels.
uniform sampler2D u_old_folds;
uniform vec2 u_old_fold;     // threshold and width
uniform vec4 u_old_share[4]; // of the foam of each time that is left

void main() {
    float finer = float(SEA_DISPLACED) / float(AGE_SIZE);
    sea_block = u_sea_block;
    vec2 at = resting(finer * floor(gl_FragCoord.xy)) * (float(OLD_SIZE) / float(SEA_DISPLACED));
    float sum = 0.0;
    for (int row = 0; row < 4; ++row) {
        vec4 left = clamp((u_old_fold.x - bilinear_wrapped(u_old_folds, ivec2(0, row * OLD_SIZE), OLD_SIZE, at)) / u_old_fold.y, 0.0, 1.0);
        sum += dot(u_old_share[row], left);
    }
    o_tile = vec4(sum, 0.0, 0.0, 0.0);
}
