// Folds of earlier times, carried to where their water is now: bilinear between texels, which lie twice as far apart as the sea's.
// Four times over the next four, a tile over the next, a pass for each; each with its first row once more at its end, so that bilinear
// reads need no wrap there.
uniform sampler2D u_age_folds;

vec4 fold_at(vec2 at, int row) {
    vec2 base = floor(at);
    vec2 t = at - base;
    ivec2 left = ivec2(int(u_sea_block), row) * AGE_SIZE;
    ivec2 near = ivec2(base) & (AGE_SIZE - 1);
    ivec2 far = (near + 1) & (AGE_SIZE - 1);
    vec4 first = mix(texelFetch(u_age_folds, left + near, 0), texelFetch(u_age_folds, left + ivec2(far.x, near.y), 0), t.x);
    vec4 second = mix(texelFetch(u_age_folds, left + ivec2(near.x, far.y), 0), texelFetch(u_age_folds, left + far, 0), t.x);
    return mix(first, second, t.y);
}

void main() {
    float finer = float(SEA_SIZE / AGE_SIZE);
    ivec2 at = ivec2(gl_FragCoord.xy);
    int row = at.y / (AGE_SIZE + 1);
    if (row / AGE_ROWS != int(u_sea_block)) {
        discard;
    }
    at.y = (at.y - row * (AGE_SIZE + 1)) & (AGE_SIZE - 1);
    row -= int(u_sea_block) * AGE_ROWS;
    o_tile = fold_at(resting(finer * vec2(at)) / finer, row);
}
