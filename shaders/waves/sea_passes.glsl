// The sea's maps: its spectrum or sum of waves, the Fourier transform, and tiles. Water is drawn in square blocks of BLOCK_SIZE texels, for
// BLOCK_TIMES times of each tile. Layers of a target are quarters of a block: of its columns until these are transformed, then of its rows.

// @part spectrum
// Complex amplitudes of a tile's waves at one moment, h0(k) e^(-i w t) + conj(h0(-k)) e^(i w t) (Tessendorf 2001); m.
// w t is a whole number of turns times the moment's place in the loop: coarse and fine part each exact in float32.
uniform sampler2D u_sea_spectrum; // lower half h0, upper half turns in a loop; wave (ix, iz) at (ix, iz) + SEA_BAND, tiles side by side
uniform float u_sea_loop;         // t modulo SEA_LOOP, s
uniform float u_sea_fine;         // t modulo SEA_LOOP / 1024, s

// Wavenumbers along each side of a block's spectrum: those beyond the band would be 0.
const int SPECTRUM_SIDE = min(2 * SEA_BAND, BLOCK_SIZE);

// `before`: seconds before the frame's time.
vec2 amplitude(ivec2 k, int tile, float before) {
    ivec2 at = ivec2(2 * SEA_BAND * tile + SEA_BAND, SEA_BAND);
    vec2 along = texel_at(u_sea_spectrum, at + k).rg;
    vec2 opposite = texel_at(u_sea_spectrum, at - k).rg;
    // One of the two is 0 where waves against the wind are suppressed, and then only the other knows its turns.
    float turns = max(
        texel_at(u_sea_spectrum, at + k + ivec2(0, 2 * SEA_BAND)).r,
        texel_at(u_sea_spectrum, at - k + ivec2(0, 2 * SEA_BAND)).r);
    float coarse = floor((u_sea_loop - u_sea_fine) * (1024.0 / SEA_LOOP) + 0.5);
    // turns < 2^14 and coarse <= 2^10: their product is exact, and so is its fraction.
    float turn = fract(turns * coarse / 1024.0) + turns * ((u_sea_fine - before) / SEA_LOOP);
    float angle = TAU * (turn - floor(turn + 0.5));
    vec2 back = vec2(cos(angle), -sin(angle));
    return complex_product(along, back) + complex_product(opposite * vec2(1.0, -1.0), back * vec2(1.0, -1.0));
}

// @part gerstner
// Waves with whole wavenumbers on two tiles (Gerstner): summed one by one, so each tile closes exactly.
uniform vec4 u_gerstner[GERSTNER_WAVES];       // waves along x and z of the tile, amplitude (m), frequency (rad/s)
uniform float u_gerstner_phase[GERSTNER_WAVES];

// First wave of a tile, and the one after its last.
ivec2 gerstner_waves(int tile) {
    return tile == 0 ? ivec2(0, GERSTNER_FIRST) : ivec2(GERSTNER_FIRST, GERSTNER_WAVES);
}

// Phase at a texel's corner: k.x is a whole number of parts of a turn.
float gerstner_theta(int wave, ivec2 texel, int size) {
    ivec2 k = as_int(u_gerstner[wave].xy);
    int part = (k.x * texel.x + k.y * texel.y) & (size - 1);
    return wrap_phase(u_gerstner_phase[wave] + TAU / float(size) * float(part));
}

// @part gerstner_pass
// Height and displacement D = -a k/|k| sin(theta) of a tile's waves, as coefficients of a cubic B-spline; (h, Dx, Dz), m.
vec4 water(ivec2 at, int tile, int time) {
    vec3 sum = vec3(0.0);
    ivec2 waves = gerstner_waves(tile);
    for (int i = waves.x; i < waves.y; ++i) {
        vec2 turn = whole_sine_cosine(gerstner_theta(i, at, BLOCK_SIZE));
        sum += u_gerstner[i].z * vec3(turn.y, -turn.x * normalize(u_gerstner[i].xy));
    }
    return vec4(sum, 0.0);
}

// @part displaced_pass
// Spectra of height and displacement D = i k/|k| h, two real fields in each complex one: (h + i Dx, Dz). Divided by the cubic B-spline's
// response, so that what the transform gives are the coefficients of a spline through the sea.
vec4 spectra(vec2 k, int tile, int time) {
    vec2 spline = (2.0 + cos(k * (TAU / float(BLOCK_SIZE)))) / 3.0;
    vec2 h = amplitude(as_int(k), tile, 0.0) / (spline.x * spline.y);
    vec2 way = normalize(k);
    return vec4((1.0 - way.x) * h, way.y * vec2(-h.y, h.x));
}

// @part four
// What a pass draws into the layers of its target.
layout(location = 0) out vec4 o_first;
layout(location = 1) out vec4 o_second;
layout(location = 2) out vec4 o_third;
layout(location = 3) out vec4 o_fourth;

// @part water_pass
// Sums of waves at the rows of a block.
vec4 water_in(int layer) {
    ivec2 at = as_int(floor(gl_FragCoord.xy));
    int block = at.y / (BLOCK_SIZE / 4);
    return water(ivec2(at.x, at.y + (layer - block) * (BLOCK_SIZE / 4)), block / BLOCK_TIMES, block % BLOCK_TIMES);
}

void main() {
    o_first = water_in(0);
    o_second = water_in(1);
    o_third = water_in(2);
    o_fourth = water_in(3);
}

// @part spectra_pass
// Spectra of blocks. Beyond the band, and at Nyquist, whose wave has no partner: 0.
vec4 spectra_in(int layer) {
    ivec2 at = as_int(floor(gl_FragCoord.xy));
    int block = at.y / SPECTRUM_SIDE;
    ivec2 k = at + ivec2(layer * (SPECTRUM_SIDE / 4), -block * SPECTRUM_SIDE);
    k -= SPECTRUM_SIDE * ivec2(greaterThanEqual(k, ivec2(SPECTRUM_SIDE / 2)));
    bool held = all(lessThan(abs(k), ivec2(SPECTRUM_SIDE / 2))) && k != ivec2(0);
    return held ? spectra(vec2(k), block / BLOCK_TIMES, block % BLOCK_TIMES) : vec4(0.0);
}

void main() {
    o_first = spectra_in(0);
    o_second = spectra_in(1);
    o_third = spectra_in(2);
    o_fourth = spectra_in(3);
}

// @part complex
// Complex numbers are (real, imaginary).
vec2 complex_product(vec2 a, vec2 b) {
    return vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}

// @part fft
// Inverse Fourier transforms of blocks along rows or columns (Cooley and Tukey 1965), two complex numbers a texel. A pass sums over the
// two highest bits of the wavenumber that are left, which become the next two of the place. A texel's place along the axis is made of the
// place's bits, without its highest two, which are the layer, and below them those that are left of the wavenumber.
uniform sampler2DArray u_fft_from;
uniform sampler2D u_fft_twiddles; // e^(2 pi i j / 512)
uniform vec3 u_fft;               // bits along a side of a block; of the place so far; 0 along rows or 1 along columns

vec4 turned(vec2 root, vec4 v) {
    return vec4(complex_product(root, v.xy), complex_product(root, v.zw));
}

vec4 quarter_turned(vec4 v) {
    return vec4(-v.y, v.x, -v.w, v.z);
}

vec2 root(int part) {
    return texel_at(u_fft_twiddles, ivec2(part, 0)).rg;
}

void sums_of_four(vec4 a, vec4 b, vec4 c, vec4 d) {
    vec4 turn = quarter_turned(b - d);
    o_first = a + c + (b + d);
    o_second = a - c + turn;
    o_third = a + c - (b + d);
    o_fourth = a - c - turn;
}

// @part fft_first_pass
// The first pass along an axis: from SPECTRUM_SIDE wavenumbers, the others are 0.
vec4 wave_at(int quarter) {
    ivec2 at = as_int(floor(gl_FragCoord.xy));
    int size = 1 << as_int(u_fft.x);
    int side = min(2 * SEA_BAND, size);
    bool down = u_fft.z > 0.5;
    int place = (down ? at.y : at.x) & (size / 4 - 1);
    int k = quarter * (size / 4) + place - (quarter < 2 ? 0 : size);
    int held = k & (side - 1);
    ivec3 from = down
        ? ivec3(at.x & (size / 4 - 1), ((at.y - place) >> (as_int(u_fft.x) - 2)) * side + held, at.x >> (as_int(u_fft.x) - 2))
        : ivec3(held & (side / 4 - 1), at.y, 4 * held >= 3 * side ? 3 : 2 * held >= side ? 2 : 4 * held >= side ? 1 : 0);
    return -side / 2 <= k && k < side / 2 ? texel_at(u_fft_from, from) : vec4(0.0);
}

void main() {
    sums_of_four(wave_at(0), FFT_SPREADS ? vec4(0.0) : wave_at(1), FFT_SPREADS ? vec4(0.0) : wave_at(2), wave_at(3));
}

// @part fft_pass
// A further pass.
void main() {
    int done = as_int(u_fft.y);
    int left = as_int(u_fft.x) - done;
    bool down = u_fft.z > 0.5;
    ivec2 at = as_int(floor(gl_FragCoord.xy));
    // All are powers of 2: shifts and masks stand for divisions, which drivers on processors make lane by lane.
    int place = (down ? at.y : at.x) & ((1 << (as_int(u_fft.x) - 2)) - 1);
    int found = place >> (left - 2);
    int first = ((found & ((1 << (done - 2)) - 1)) << left) + (place & ((1 << (left - 2)) - 1)) - place;
    ivec3 from = ivec3(at, found >> (done - 2)) + (down ? ivec3(0, first, 0) : ivec3(first, 0, 0));
    ivec3 apart = (down ? ivec3(0, 1, 0) : ivec3(1, 0, 0)) << (left - 2);
    vec2 once = root(found << (7 - done));
    vec2 twice = complex_product(once, once);
    sums_of_four(
        texel_at(u_fft_from, from),
        turned(once, texel_at(u_fft_from, from + apart)),
        turned(twice, texel_at(u_fft_from, from + 2 * apart)),
        turned(complex_product(once, twice), texel_at(u_fft_from, from + 3 * apart)));
}

// @part fft_last_pass
// The last pass of an odd number of bits: over one. Each texel sums for both values of the place's highest bit so far.
void main() {
    int done = as_int(u_fft.y);
    bool down = u_fft.z > 0.5;
    ivec2 at = as_int(floor(gl_FragCoord.xy));
    int place = (down ? at.y : at.x) & ((1 << (done - 1)) - 1);
    int first = 2 * (place & ((1 << (done - 2)) - 1)) - place;
    ivec3 from = ivec3(at, place >> (done - 2)) + (down ? ivec3(0, first, 0) : ivec3(first, 0, 0));
    ivec3 beside = down ? ivec3(0, 1, 0) : ivec3(1, 0, 0);
    vec2 once = root(place << (8 - done));
    vec4 a = texel_at(u_fft_from, from);
    vec4 b = turned(once, texel_at(u_fft_from, from + beside));
    from.z += 2;
    vec4 c = texel_at(u_fft_from, from);
    vec4 d = quarter_turned(turned(once, texel_at(u_fft_from, from + beside)));
    o_first = a + b;
    o_second = c + d;
    o_third = a - b;
    o_fourth = c - d;
}

// @part blocks
// A texel of a block of water, periodic.
vec4 block_texel(sampler2DArray blocks, int size, int block, ivec2 at) {
    at &= size - 1;
    int layer = at.y / (size / 4);
    return texel_at(blocks, ivec3(at.x, at.y + (block - layer) * (size / 4), layer));
}

// Bilinear between texels.
vec4 block_between(sampler2DArray blocks, int size, int block, vec2 at) {
    vec2 base = floor(at);
    vec2 t = at - base;
    ivec2 first = as_int(base);
    vec4 row = mix(block_texel(blocks, size, block, first), block_texel(blocks, size, block, first + ivec2(1, 0)), t.x);
    vec4 next = mix(block_texel(blocks, size, block, first + ivec2(0, 1)), block_texel(blocks, size, block, first + 1), t.x);
    return mix(row, next, t.y);
}

// @part tile_pass
// A texel of the height field: what the water that is there has brought along.
uniform float u_sea_corner; // texels of displaced water from one corner of the height field to the next
uniform vec2 u_sea_limit;   // of height (m) and slope

void main() {
    sea_block = u_sea_block;
    Displaced here = displaced(resting(floor(gl_FragCoord.xy) * u_sea_corner));
    vec3 a = stretch(here);
    vec2 slope = unstretched(a, vec2(here.by_x.x, here.by_z.x) / sea_block.y);
    slope *= min(1.0, u_sea_limit.y / max(length(slope), 1e-30));
    o_tile = vec4(clamp(here.value.x, -u_sea_limit.x, u_sea_limit.x), slope, a.x + a.y - 2.0);
}

// @part fetch_exact
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
    ivec2 first = as_int(base) & (size - 1);
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
            ivec2 texel = (as_int(base) + ivec2(i - 1, j - 1)) & (size - 1);
            sum += across[i] * down[j] * texel_at(tile, texel);
        }
    }
    return sum;
}

// @part fetch_linear
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

// @part resample_pass
// From displaced water to a height field: x + l D(x) = p solved at each corner p of the tile by Newton's method on a cubic B-spline.
// Writes height about 0 (m), slopes, and the divergence l div D, the Jacobian less 1 to first order. docs/formulae.md, section 2.
uniform sampler2DArray u_sea_displaced; // spline coefficients of (h, Dx, Dz), a block for each tile
uniform vec3 u_sea_block;          // which of the tiles, a texel of it (m), choppiness
out vec4 o_tile;

// The tile that is asked for, as above.
vec3 sea_block;

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
    for (int j = 0; j < 4; ++j) {
        vec3 along = vec3(0.0);
        vec3 rise = vec3(0.0);
        for (int i = 0; i < 4; ++i) {
            vec3 c = block_texel(u_sea_displaced, SEA_DISPLACED, as_int(sea_block.x), as_int(base) + ivec2(i - 1, j - 1)).xyz;
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
    float scale = sea_block.z / sea_block.y;
    return vec3(1.0 + scale * here.by_x.y, 1.0 + scale * here.by_z.z, 0.5 * scale * (here.by_x.z + here.by_z.y));
}

// Its inverse times v; the determinant is held, since a height field cannot turn over.
vec2 unstretched(vec3 a, vec2 v) {
    return vec2(a.y * v.x - a.z * v.y, a.x * v.y - a.z * v.x) / max(a.x * a.y - a.z * a.z, SEA_LEAST_JACOBIAN);
}

// Where the water rests that is at p, texels; x: where it is looked for first.
vec2 rested(vec2 p, vec2 x, int steps) {
    for (int i = 0; i < steps; ++i) {
        Displaced here = displaced(x);
        x -= unstretched(stretch(here), x + sea_block.z / sea_block.y * here.value.yz - p);
    }
    return x;
}

// @part resting
// The same, looked for from p itself.
vec2 resting(vec2 p) {
    return rested(p, p, SEA_NEWTON);
}

// @part resting_found
// The same, looked for from where the map of orbits has it, if it has the tile.
uniform sampler2D u_sea_orbits; // x, z: to the resting place, m

vec2 resting(vec2 p) {
    bool found = sea_block.x < 1.5;
    vec2 way = sea_fetch_four(u_sea_orbits, p / float(SEA_DISPLACED), as_int(sea_block.x)).xy / sea_block.y;
    return rested(p, found ? p + way : p, found ? SEA_NEWTON_FOUND : SEA_NEWTON);
}
