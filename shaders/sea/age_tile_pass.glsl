// Folds of earlier times, carried to where their water is now: bilinear between texels, which lie twice as far apart as the sea's.
uniform sampler2D u_age_folds;
uniform float u_age_row; // which four times

vec4 fold_at(vec2 at) {
    vec2 base = floor(at);
    vec2 t = at - base;
    ivec2 left = ivec2(int(u_sea_block), int(u_age_row)) * AGE_SIZE;
    ivec2 near = ivec2(base) & (AGE_SIZE - 1);
    ivec2 far = (near + 1) & (AGE_SIZE - 1);
    vec4 first = mix(texelFetch(u_age_folds, left + near, 0), texelFetch(u_age_folds, left + ivec2(far.x, near.y), 0), t.x);
    vec4 second = mix(texelFetch(u_age_folds, left + ivec2(near.x, far.y), 0), texelFetch(u_age_folds, left + far, 0), t.x);
    return mix(first, second, t.y);
}

void main() {
    float finer = float(SEA_SIZE / AGE_SIZE);
    o_tile = fold_at(resting(finer * floor(gl_FragCoord.xy)) / finer);
}
