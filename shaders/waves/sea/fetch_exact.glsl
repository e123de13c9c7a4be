// Tiles between their texels, written out: floats, which not every device filters. at: in tiles; texel j stands at j / size.

vec4 sea_fetch(sampler2D tile, vec2 at) {
    int size = textureSize(tile, 0).x;
    return bilinear_wrapped(tile, ivec2(0), size, fract(at) * float(size));
}

// The same of one of several tiles over one another, each with its first row once more at its end.
vec4 sea_fetch_four(sampler2D tiles, vec2 at, int which) {
    int size = textureSize(tiles, 0).x;
    vec2 place = fract(at) * float(size);
    vec2 base = floor(place);
    ivec2 first = ivec2(base) & (size - 1);
    int row = which * (size + 1) + first.y;
    return bilinear_between(tiles, ivec2(first.x, row), ivec2((first.x + 1) & (size - 1), row + 1), place - base);
}

// The uniform cubic B-spline with the texels as coefficients: bilinear slopes would show the grid.
vec4 sea_smooth(sampler2D tile, vec2 at) {
    int size = textureSize(tile, 0).x;
    vec2 place = fract(at) * float(size);
    vec2 base = floor(place);
    vec2 t = place - base;
    vec4 across = spline_weights(t.x);
    vec4 down = spline_weights(t.y);
    vec4 sum = vec4(0.0);
    for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
            ivec2 texel = (ivec2(base) + ivec2(i - 1, j - 1)) & (size - 1);
            sum += across[i] * down[j] * texel_at(tile, texel);
        }
    }
    return sum;
}
