// The sea as it was when each batch of drops was born: height and displacement as coefficients of a cubic B-spline, and the divergence
// l div D; two tiles side by side, batches over one another. docs/formulae.md, section 13.
uniform sampler2D u_spray_seas;
uniform vec2 u_spray_choppiness; // of the tiles, texels a metre of displacement
uniform vec2 u_spray_limit;      // of the tiles' heights, m
uniform vec2 u_spray_fold;       // threshold of the divergence, and one over the width from which it breaks as hard as it can

vec4 spray_texel(int tile, int batch, ivec2 at) {
    return texel_at(u_spray_seas, ivec2(tile, batch) * SPRAY_TEXELS + (at & (SPRAY_TEXELS - 1)));
}

// Height of a tile at a corner of the drawn one: as resample_pass.glsl finds it, m. p: texels of the tile here.
float spray_corner(int tile, int batch, vec2 p) {
    float chop = tile == 0 ? u_spray_choppiness.x : u_spray_choppiness.y;
    vec2 x = p;
    float height = 0.0;
    for (int step = 0; step <= SEA_NEWTON; ++step) {
        vec2 base = floor(x);
        vec2 t = x - base;
        vec4 wx = spline_weights(t.x);
        vec4 wz = spline_weights(t.y);
        vec4 sx = spline_slopes(t.x);
        vec4 sz = spline_slopes(t.y);
        vec3 value = vec3(0.0);
        vec2 by_x = vec2(0.0);
        vec2 by_z = vec2(0.0);
        for (int j = 0; j < 4; ++j) {
            for (int i = 0; i < 4; ++i) {
                vec3 c = spray_texel(tile, batch, ivec2(base) + ivec2(i - 1, j - 1)).xyz;
                value += wx[i] * wz[j] * c;
                by_x += sx[i] * wz[j] * c.yz;
                by_z += wx[i] * sz[j] * c.yz;
            }
        }
        vec3 a = vec3(1.0 + chop * by_x.x, 1.0 + chop * by_z.y, 0.5 * chop * (by_x.y + by_z.x));
        vec2 error = x + chop * value.yz - p;
        x -= vec2(a.y * error.x - a.z * error.y, a.x * error.y - a.z * error.x) / max(a.x * a.y - a.z * a.z, SEA_LEAST_JACOBIAN);
        height = value.x;
    }
    return height;
}

// Height of a tile as it is drawn: bilinear between the corners of its texels, m. at: in tiles.
float spray_tile(int tile, int batch, vec2 at) {
    vec2 place = at * float(SEA_SIZE);
    vec2 base = floor(place);
    vec2 t = place - base;
    float finer = float(SPRAY_TEXELS) / float(SEA_SIZE);
    vec4 corners;
    for (int i = 0; i < 4; ++i) {
        corners[i] = spray_corner(tile, batch, finer * (base + vec2(i & 1, i >> 1)));
    }
    float limit = tile == 0 ? u_spray_limit.x : u_spray_limit.y;
    corners = clamp(corners, -limit, limit);
    vec2 rows = mix(corners.xz, corners.yw, t.x);
    return mix(rows.x, rows.y, t.y);
}

vec2 spray_place(int tile, vec2 p) {
    return tile == 0 ? p / u_sea_size_0 + u_sea_offset_0 : p / u_sea_size_1 + u_sea_offset_1;
}

// The nearest texel of a tile: the water that rests at p.
vec4 spray_near(int tile, int batch, vec2 p) {
    return spray_texel(tile, batch, ivec2(floor(spray_place(tile, p) * float(SPRAY_TEXELS) + 0.5)));
}

// How hard the sea breaks where the water rests at p, by the nearest texels. p: returns where that water is.
float sea_breaks(inout vec2 p, int batch) {
    vec4 large = spray_near(0, batch, p);
    p += large.yz * (u_spray_choppiness.x / float(SPRAY_TEXELS) * u_sea_size_0);
    vec4 small = spray_near(1, batch, p);
    return (u_spray_fold.x - large.w - small.w) * u_spray_fold.y;
}

// Height, m.
float sea_then(vec2 p, int batch) {
    return spray_tile(0, batch, spray_place(0, p)) + spray_tile(1, batch, spray_place(1, p));
}
