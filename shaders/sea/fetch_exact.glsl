// A tile between its texels, written out: floats, which not every device filters. at: in tiles; texel j stands at j / size.
vec4 sea_fetch(sampler2D tile, vec2 at) {
    int size = textureSize(tile, 0).x;
    vec2 place = fract(at) * float(size);
    vec2 base = floor(place);
    vec2 t = place - base;
    ivec2 near = ivec2(base) & (size - 1);
    ivec2 far = (near + 1) & (size - 1);
    vec4 first = mix(texelFetch(tile, near, 0), texelFetch(tile, ivec2(far.x, near.y), 0), t.x);
    return mix(first, mix(texelFetch(tile, ivec2(near.x, far.y), 0), texelFetch(tile, far, 0), t.x), t.y);
}

// The same of one of several tiles over one another, each with its first row once more at its end.
vec4 sea_fetch_four(sampler2D tiles, vec2 at, int which) {
    int size = textureSize(tiles, 0).x;
    vec2 place = fract(at) * float(size);
    vec2 base = floor(place);
    vec2 t = place - base;
    ivec2 near = ivec2(int(base.x) & (size - 1), which * (size + 1) + min(int(base.y), size - 1));
    ivec2 far = ivec2((near.x + 1) & (size - 1), near.y + 1);
    vec4 first = mix(texelFetch(tiles, near, 0), texelFetch(tiles, ivec2(far.x, near.y), 0), t.x);
    return mix(first, mix(texelFetch(tiles, ivec2(near.x, far.y), 0), texelFetch(tiles, far, 0), t.x), t.y);
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
