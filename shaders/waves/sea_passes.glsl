// The sea's maps: its spectrum or sum of waves, the Fourier transform, and tiles.

// @part spectrum
// Complex amplitudes of a tile's waves at one moment, h0(k) e^(-i w t) + conj(h0(-k)) e^(i w t) (Tessendorf 2001); m.
// w t is a whole number of turns times the moment's place in the loop: coarse and fine part each exact in float32.
uniform sampler2D u_sea_spectrum; // lower half h0, upper half turns in a loop; wave (ix, iz) at (ix, iz) + SEA_BAND, tiles side by side
uniform float u_sea_loop;         // t modulo SEA_LOOP, s
uniform float u_sea_fine;         // t modulo SEA_LOOP / 1024, s

// Rows of a block of spectra of a transform of `size`: those beyond the band would hold nothing.
int spectrum_rows(int size) {
    return min(2 * SEA_BAND, size);
}

// The whole wavevector of a texel of such a block; beyond the band and at Nyquist, whose wave has no partner: false.
bool wave_of(ivec2 texel, int size, out ivec2 k) {
    ivec2 sides = ivec2(size, spectrum_rows(size));
    k = texel - sides * ivec2(greaterThanEqual(texel, sides / 2));
    int held = min(SEA_BAND, size / 2);
    return all(lessThan(abs(k), ivec2(held))) && k != ivec2(0);
}

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
    ivec2 k = ivec2(u_gerstner[wave].xy);
    int part = (k.x * texel.x + k.y * texel.y) & (size - 1);
    return wrap_phase(u_gerstner_phase[wave] + TAU / float(size) * float(part));
}

// @part gerstner_pass
// Height and displacement D = -a k/|k| sin(theta) of a tile's waves, as coefficients of a cubic B-spline; (h, Dx, Dz), m.
out vec4 o_displaced;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec3 sum = vec3(0.0);
    ivec2 waves = gerstner_waves(at.x / SEA_DISPLACED);
    for (int i = waves.x; i < waves.y; ++i) {
        vec2 turn = whole_sine_cosine(gerstner_theta(i, at, SEA_DISPLACED));
        sum += u_gerstner[i].z * vec3(turn.y, -turn.x * normalize(u_gerstner[i].xy));
    }
    o_displaced = vec4(sum, 0.0);
}

// @part displaced_pass
// Spectra of height and displacement D = i k/|k| h, two real fields in each complex one: (h + i Dx, Dz); tiles side by side.
// Divided by the cubic B-spline's response, so that what the transform gives are the coefficients of a spline through the sea.
out vec4 o_spectra;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    ivec2 k;
    o_spectra = vec4(0.0);
    if (wave_of(ivec2(at.x % SEA_DISPLACED, at.y), SEA_DISPLACED, k)) {
        vec2 spline = (2.0 + cos(vec2(k) * (TAU / float(SEA_DISPLACED)))) / 3.0;
        vec2 h = amplitude(k, at.x / SEA_DISPLACED, 0.0) / (spline.x * spline.y);
        vec2 way = normalize(vec2(k));
        o_spectra = vec4((1.0 - way.x) * h, way.y * vec2(-h.y, h.x));
    }
}

// @part radix_4
// Texels that a pass of the transform sums, and its binary logarithm.
const int FFT_RADIX = 4;
const int FFT_BITS = 2;

// @part radix_8
// Texels that a pass of the transform sums, and its binary logarithm.
const int FFT_RADIX = 8;
const int FFT_BITS = 3;

// @part complex
vec2 complex_product(vec2 a, vec2 b) {
    return vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}

// @part fft_pass
// One pass of an inverse Fourier transform (Stockham; Govindaraju et al. 2008), along rows or columns of square blocks; two complex
// numbers a texel. Each texel sums FFT_RADIX texels of the pass before.
uniform sampler2D u_fft_from;
uniform sampler2D u_fft_twiddles; // e^(2 pi i j / 512)
uniform vec3 u_fft;               // binary logarithms of the side of a block and of the product of the radices so far; 0 along rows or 1 along columns
out vec4 o_sum;

void main() {
    int size = 1 << int(u_fft.x);
    int span = 1 << int(u_fft.y);
    int log_whole = int(u_fft.y) + FFT_BITS;
    bool down = u_fft.z > 0.5;
    ivec2 at = ivec2(gl_FragCoord.xy);
    int place = down ? at.y : at.x;
    // All are powers of 2: shifts and masks stand for divisions, which drivers on processors make lane by lane.
    int index = place & (size - 1);
    int block = place - index;
    int whole = span * FFT_RADIX;
    int first = ((index >> log_whole) * span) + (index & (span - 1));
    // Its powers by Horner's rule: reading a root of unity costs as much as reading a texel.
    vec2 root = texel_at(u_fft_twiddles, ivec2((index & (whole - 1)) << (9 - log_whole), 0)).rg;
    o_sum = vec4(0.0);
    for (int r = FFT_RADIX - 1; r >= 0; --r) {
        int from = block + first + r * (size >> FFT_BITS);
        o_sum = vec4(complex_product(root, o_sum.xy), complex_product(root, o_sum.zw)) + texel_at(u_fft_from, down ? ivec2(at.x, from) : ivec2(from, at.y));
    }
}

// @part fft_spread_pass
// The first pass along columns, from blocks of spectrum_rows to square ones: texels between these rows are 0.
uniform sampler2D u_fft_from;
uniform sampler2D u_fft_twiddles; // e^(2 pi i j / 512)
uniform vec3 u_fft;               // binary logarithm of the side of a block
out vec4 o_sum;

void main() {
    int bits = int(u_fft.x);
    ivec2 at = ivec2(gl_FragCoord.xy);
    int index = at.y & ((1 << bits) - 1);
    int first = (at.y >> bits) * 2 * SEA_BAND + (index >> FFT_BITS);
    int turn = (index & (FFT_RADIX - 1)) << (9 - FFT_BITS);
    int apart = 1 << (bits - FFT_BITS);
    int read = 2 * SEA_BAND / apart;
    o_sum = vec4(0.0);
    for (int i = 0; i < read; ++i) {
        int r = 2 * i < read ? i : i + FFT_RADIX - read;
        vec4 v = texel_at(u_fft_from, ivec2(at.x, first + i * apart));
        vec2 w = texel_at(u_fft_twiddles, ivec2((r * turn) & 511, 0)).rg;
        o_sum += vec4(w.x * v.x - w.y * v.y, w.x * v.y + w.y * v.x, w.x * v.z - w.y * v.w, w.x * v.w + w.y * v.z);
    }
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
uniform sampler2D u_sea_displaced; // spline coefficients of (h, Dx, Dz), tiles side by side
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
    int left = int(sea_block.x) * SEA_DISPLACED;
    for (int j = 0; j < 4; ++j) {
        vec3 along = vec3(0.0);
        vec3 rise = vec3(0.0);
        for (int i = 0; i < 4; ++i) {
            ivec2 texel = (ivec2(base) + ivec2(i - 1, j - 1)) & (SEA_DISPLACED - 1);
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
    float scale = sea_block.z / sea_block.y;
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
        x -= unstretched(stretch(here), x + sea_block.z / sea_block.y * here.value.yz - p);
    }
    return x;
}
