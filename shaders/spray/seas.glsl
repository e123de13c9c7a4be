// The sea at the drops' births.

// @part sea_none
// No sea from a spectrum.
float sea_breaks(inout vec2 p, int batch) {
    return 0.0;
}

float sea_then(vec2 p, int batch) {
    return 0.0;
}

// @part sea_waves
// The sea as it was when each batch of drops was born: height and displacement as coefficients of a cubic B-spline, and the divergence
// l div D; two tiles, a block for each batch. docs/formulae.md, section 13.
uniform sampler2DArray u_spray_seas;
uniform vec2 u_spray_choppiness; // of the tiles, texels a metre of displacement
uniform vec2 u_spray_limit;      // of the tiles' heights, m
uniform vec2 u_spray_fold;       // threshold of the divergence, and one over the width from which it breaks as hard as it can

vec4 spray_texel(int tile, int batch, ivec2 at) {
    return block_texel(u_spray_seas, SPRAY_TEXELS, tile * SPRAY_BATCHES + batch, at);
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
                vec3 c = spray_texel(tile, batch, as_int(base) + ivec2(i - 1, j - 1)).xyz;
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
    float limit = tile == 0 ? u_spray_limit.x : u_spray_limit.y;
    float height = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec2 corner = vec2(i & 1, i >> 1);
        vec2 share = mix(1.0 - t, t, corner);
        height += share.x * share.y * clamp(spray_corner(tile, batch, finer * (base + corner)), -limit, limit);
    }
    return height;
}

vec2 spray_place(int tile, vec2 p) {
    return tile == 0 ? p / u_sea_size_0 + u_sea_offset_0 : p / u_sea_size_1 + u_sea_offset_1;
}

// The nearest texel of a tile: the water that rests at p.
vec4 spray_near(int tile, int batch, vec2 p) {
    return spray_texel(tile, batch, as_int(floor(spray_place(tile, p) * float(SPRAY_TEXELS) + 0.5)));
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
    float height = 0.0;
    for (int tile = 0; tile < 2; ++tile) {
        height += spray_tile(tile, batch, spray_place(tile, p));
    }
    return height;
}

// @part times
// Times of the births of batches.
uniform vec2 u_spray_scale; // l 2 pi / side of the first and second tile, rad/m
uniform float u_spray_step;

// Seconds from the birth of a batch to that of the last.
float spray_before(int batch) {
    return float(batch) * u_spray_step;
}

// @part gerstner_pass
// Height, displacement and divergence of a tile's waves when each batch of drops was born, as coefficients of a cubic B-spline:
// (h, Dx, Dz, F), F = l div D.
uniform float u_spray_time[2];

vec4 water(ivec2 at, int tile, int time) {
    ivec2 waves = gerstner_waves(tile);
    float scale = tile == 0 ? u_spray_scale.x : u_spray_scale.y;
    vec4 sum = vec4(0.0);
    for (int i = waves.x; i < waves.y; ++i) {
        vec4 wave = u_gerstner[i];
        vec2 turn = whole_sine_cosine(wrap_phase(gerstner_theta(i, at, BLOCK_SIZE) + wave.w * (u_spray_time[0] + spray_before(time))));
        float number = length(wave.xy);
        sum += wave.z * vec4(turn.y, -turn.x * wave.xy / number, -scale * number * turn.y);
    }
    return sum;
}

// @part spectrum_pass
// Spectra of the sea when each batch of drops was born, the frame's time being the last birth: (h + i Dx, Dz + i F),
// F = l div D = -l |k| h. Divided by the cubic B-spline's response.
vec4 spectra(vec2 k, int tile, int time) {
    vec2 spline = (2.0 + cos(k * (TAU / float(BLOCK_SIZE)))) / 3.0;
    vec2 h = amplitude(as_int(k), tile, spray_before(time)) / (spline.x * spline.y);
    float number = length(k);
    vec2 way = k / number;
    float second = way.y - number * (tile == 0 ? u_spray_scale.x : u_spray_scale.y);
    return vec4((1.0 - way.x) * h, second * vec2(-h.y, h.x));
}
