// Folds of earlier times, carried to where their water is now: bilinear between texels, which lie twice as far apart as the sea's.
// Four times over the next four, a tile over the next, a pass for each; each with its first row once more at its end, so that bilinear
// reads need no wrap there.
uniform sampler2D u_age_folds;

void main() {
    float finer = float(SEA_SIZE / AGE_SIZE);
    ivec2 at = ivec2(gl_FragCoord.xy);
    int row = at.y / (AGE_SIZE + 1);
    if (row / AGE_ROWS != int(u_sea_block)) {
        discard;
    }
    at.y = (at.y - row * (AGE_SIZE + 1)) & (AGE_SIZE - 1);
    row -= int(u_sea_block) * AGE_ROWS;
    o_tile = bilinear_wrapped(u_age_folds, ivec2(int(u_sea_block), row) * AGE_SIZE, AGE_SIZE, resting(finer * vec2(at)) / finer);
}
