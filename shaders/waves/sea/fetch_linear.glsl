// A tile between its texels, by the sampler: half floats. at: in tiles; texel j stands at j / size.
vec4 sea_fetch(sampler2D tile, vec2 at) {
    return textureLod(tile, at + 0.5 / vec2(textureSize(tile, 0)), 0.0);
}

// The same of one of several tiles over one another, each with its first row once more at its end.
vec4 sea_fetch_four(sampler2D tiles, vec2 at, int which) {
    vec2 size = vec2(textureSize(tiles, 0));
    float row = float(which) * (size.x + 1.0) + fract(at.y) * size.x;
    return textureLod(tiles, vec2(at.x * size.x + 0.5, row + 0.5) / size, 0.0);
}

// The uniform cubic B-spline with the texels as coefficients, by four bilinear reads (Sigg and Hadwiger 2005): bilinear slopes would
// show the grid.
vec4 sea_smooth(sampler2D tile, vec2 at) {
    float size = float(textureSize(tile, 0).x);
    vec2 place = fract(at) * size;
    vec2 base = floor(place);
    vec2 t = place - base;
    vec4 across = spline_weights(t.x);
    vec4 down = spline_weights(t.y);
    vec2 near = vec2(across.x + across.y, down.x + down.y);
    vec2 far = 1.0 - near;
    vec2 low = (base - 0.5 + vec2(across.y, down.y) / near) / size;
    vec2 high = (base + 1.5 + vec2(across.w, down.w) / far) / size;
    return near.y * (near.x * textureLod(tile, low, 0.0) + far.x * textureLod(tile, vec2(high.x, low.y), 0.0))
        + far.y * (near.x * textureLod(tile, vec2(low.x, high.y), 0.0) + far.x * textureLod(tile, high, 0.0));
}
