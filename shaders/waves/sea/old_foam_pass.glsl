// Foam that the waves of the largest tile left at 16 times long ago, on the water that was there, where that water is now:
// sum of a_j clamp((threshold - F_j) / width, 0, 1). Folds: four times over the next four, bilinear between texels.
uniform sampler2D u_old_folds;
uniform vec2 u_old_fold;     // threshold and width
uniform vec4 u_old_share[4]; // of the foam of each time that is left

void main() {
    float finer = float(SEA_SIZE / AGE_SIZE);
    vec2 at = resting(finer * floor(gl_FragCoord.xy)) * (float(OLD_SIZE) / float(SEA_SIZE));
    float sum = 0.0;
    for (int row = 0; row < 4; ++row) {
        vec4 left = clamp((u_old_fold.x - bilinear_wrapped(u_old_folds, ivec2(0, row * OLD_SIZE), OLD_SIZE, at)) / u_old_fold.y, 0.0, 1.0);
        sum += dot(u_old_share[row], left);
    }
    o_tile = vec4(sum, 0.0, 0.0, 0.0);
}
