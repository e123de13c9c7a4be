// Tiles between their texels, written out: floats, which not every device filters. at: in tiles; texel j stands at j / size.
// t: share of the way from the near texel to the far one.
vec4 sea_between(sampler2D tiles, ivec2 near, ivec2 far, vec2 t) {
    vec4 first = mix(texelFetch(tiles, near, 0), texelFetch(tiles, ivec2(far.x, near.y), 0), t.x);
    return mix(first, mix(texelFetch(tiles, ivec2(near.x, far.y), 0), texelFetch(tiles, far, 0), t.x), t.y);
}

vec4 sea_fetch(sampler2D tile, vec2 at) {
    int size = textureSize(tile, 0).x;
    vec2 place = fract(at) * float(size);
    vec2 base = floor(place);
    ivec2 near = ivec2(base) & (size - 1);
    return sea_between(tile, near, (near + 1) & (size - 1), place - base);
}

// The same of one of several tiles over one another, each with its first row once more at its end.
vec4 sea_fetch_four(sampler2D tiles, vec2 at, int which) {
    int size = textureSize(tiles, 0).x;
    vec2 place = fract(at) * float(size);
    vec2 base = floor(place);
    ivec2 near = ivec2(base) & (size - 1);
    int first = which * (size + 1);
    return sea_between(tiles, near + ivec2(0, first), ivec2((near.x + 1) & (size - 1), first + near.y + 1), place - base);
}

// The uniform cubic B-spline with the texels as coefficients: bilinear slopes would show the grid.
vec4 sea_smooth(sampler2D tile, vec2 at) {
    int size = textureSize(tile, 0).x;
    vec2 place = fract(at) * float(size);
    vec2 base = floor(place);
    vec2 t = place - base;
    vec2 u = 1.0 - t;
    vec2 weights[4] = vec2[4](u * u * u, (3.0 * t - 6.0) * t * t + 4.0, (3.0 * u - 6.0) * u * u + 4.0, t * t * t);
    vec4 sum = vec4(0.0);
    for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
            ivec2 texel = (ivec2(base) + ivec2(i - 1, j - 1)) & (size - 1);
            sum += weights[i].x * weights[j].y / 36.0 * texelFetch(tile, texel, 0);
        }
    }
    return sum;
}
