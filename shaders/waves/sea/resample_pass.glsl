// From displaced water to a height field: x + l D(x) = p solved at each corner p of the tile by Newton's method on a cubic B-spline.
// Writes height about 0 (m), slopes, and the divergence l div D, the Jacobian less 1 to first order. docs/formulae.md, section 2.
uniform sampler2D u_sea_displaced; // spline coefficients of (h, Dx, Dz), tiles side by side
uniform float u_sea_block;         // which of the tiles
uniform float u_sea_texel;         // m
uniform float u_sea_choppiness;
uniform vec2 u_sea_limit;          // of height (m) and slope
out vec4 o_tile;

// Height and displacement at a place, texels, and their derivatives by it.
struct Displaced {
    vec3 value;
    vec3 by_x;
    vec3 by_z;
};

Displaced displaced(vec2 at) {
    vec2 base = floor(at);
    vec2 t = at - base;
    vec4 wx = spline_weights(t.x);
    vec4 wz = spline_weights(t.y);
    vec4 sx = spline_slopes(t.x);
    vec4 sz = spline_slopes(t.y);
    Displaced sum = Displaced(vec3(0.0), vec3(0.0), vec3(0.0));
    int left = int(u_sea_block) * SEA_SIZE;
    for (int j = 0; j < 4; ++j) {
        vec3 along = vec3(0.0);
        vec3 rise = vec3(0.0);
        for (int i = 0; i < 4; ++i) {
            ivec2 texel = (ivec2(base) + ivec2(i - 1, j - 1)) & (SEA_SIZE - 1);
            vec3 c = texel_at(u_sea_displaced, ivec2(left + texel.x, texel.y)).xyz;
            along += wx[i] * c;
            rise += sx[i] * c;
        }
        sum.value += wz[j] * along;
        sum.by_x += wz[j] * rise;
        sum.by_z += sz[j] * along;
    }
    return sum;
}

// 1 + l dD/dx: (xx, zz, xz).
vec3 stretch(Displaced here) {
    float scale = u_sea_choppiness / u_sea_texel;
    return vec3(1.0 + scale * here.by_x.y, 1.0 + scale * here.by_z.z, 0.5 * scale * (here.by_x.z + here.by_z.y));
}

// Its inverse times v; the determinant is held, since a height field cannot turn over.
vec2 unstretched(vec3 a, vec2 v) {
    return vec2(a.y * v.x - a.z * v.y, a.x * v.y - a.z * v.x) / max(a.x * a.y - a.z * a.z, SEA_LEAST_JACOBIAN);
}

// Where the water rests that is at p, texels.
vec2 resting(vec2 p) {
    vec2 x = p;
    for (int i = 0; i < SEA_NEWTON; ++i) {
        Displaced here = displaced(x);
        x -= unstretched(stretch(here), x + u_sea_choppiness / u_sea_texel * here.value.yz - p);
    }
    return x;
}
