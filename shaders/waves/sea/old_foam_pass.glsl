// Foam that the waves of the largest tile left at 16 times long ago, on the water that was there, where that water is now:
// sum of a_j clamp((threshold - F_j) / width, 0, 1). Folds: four times over the next four, bilinear between texels.
uniform sampler2D u_old_folds;
uniform vec2 u_old_fold;     // threshold and width
uniform vec4 u_old_share[4]; // of the foam of each time that is left

vec4 old_fold_at(vec2 at, int row) {
    vec2 base = floor(at);
    vec2 t = at - base;
    ivec2 first = ivec2(0, row * OLD_SIZE);
    ivec2 near = ivec2(base) & (OLD_SIZE - 1);
    ivec2 far = (near + 1) & (OLD_SIZE - 1);
    vec4 low = mix(texelFetch(u_old_folds, first + near, 0), texelFetch(u_old_folds, first + ivec2(far.x, near.y), 0), t.x);
    vec4 high = mix(texelFetch(u_old_folds, first + ivec2(near.x, far.y), 0), texelFetch(u_old_folds, first + far, 0), t.x);
    return mix(low, high, t.y);
}

void main() {
    float finer = float(SEA_SIZE / AGE_SIZE);
    vec2 at = resting(finer * floor(gl_FragCoord.xy)) * (float(OLD_SIZE) / float(SEA_SIZE));
    float sum = 0.0;
    for (int row = 0; row < 4; ++row) {
        vec4 left = clamp((u_old_fold.x - old_fold_at(at, row)) / u_old_fold.y, 0.0, 1.0);
        sum += dot(u_old_share[row], left);
    }
    o_tile = vec4(sum, 0.0, 0.0, 0.0);
}
