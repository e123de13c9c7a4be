// Noise: the hash, value noise, Perlin's in two and three dimensions, slopes.

// @part hash
// Hash of whole numbers (PCG-RXS-M-XS 32, O'Neill 2014): the same on every driver.
uint noise_hash(uint state) {
    state = state * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// In [0, 1), by the upper 24 bits.
float noise_share(uint word) {
    return float(word >> 8u) / 16777216.0;
}

// @part value
// Value noise on a hash of whole numbers (PCG, O'Neill 2014): the same on every driver.
const uint NOISE_KEY = 0x9031965Fu; // pcg(0x9E3779B9): any number would do

float noise_corner(uint key, ivec2 cell) {
    return noise_share(noise_hash(noise_hash(key ^ uint(cell.x)) ^ uint(cell.y)));
}

// In [0, 1], one cell a unit; another key is other noise.
float noise_value(uint key, vec2 x) {
    vec2 base = floor(x);
    vec2 t = x - base;
    t = t * t * (3.0 - 2.0 * t);
    ivec2 cell = as_int(base);
    return mix(
        mix(noise_corner(key, cell), noise_corner(key, cell + ivec2(1, 0)), t.x),
        mix(noise_corner(key, cell + ivec2(0, 1)), noise_corner(key, cell + ivec2(1, 1)), t.x), t.y);
}

// @part perlin_2
// Gradient noise in the plane (Perlin 2002: quintic fade), one cell a unit, standard deviation 0.1763. It repeats after 256 cells, and
// so do the octaves: each is the last turned by 26.6 degrees and made finer by the root of 5, which is a matrix of whole numbers.
// docs/formulae.md, section 9.
float noise_corner(uint row, int j, vec2 way) {
    uint word = noise_hash(row ^ uint(j & 255));
    return dot(vec2(float(word & 65535u), float(word >> 16u)) / 32767.5 - 1.0, way);
}

float noise_2(vec2 x, uint seed) {
    vec2 base = floor(x);
    vec2 t = x - base;
    vec2 w = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    ivec2 cell = as_bits(base);
    uint near = noise_hash(uint(cell.x & 255) ^ seed);
    uint far = noise_hash(uint((cell.x + 1) & 255) ^ seed);
    return mix(
        mix(noise_corner(near, cell.y, t), noise_corner(far, cell.y, t - vec2(1.0, 0.0)), w.x),
        mix(noise_corner(near, cell.y + 1, t - vec2(0.0, 1.0)), noise_corner(far, cell.y + 1, t - vec2(1.0, 1.0)), w.x),
        w.y);
}

// Octaves of 0.58 of the strength each, standard deviation 1 in all; each is gone before its cell is seen under 1.7 widths.
float fractal_2(vec2 x, float width, int octaves, uint seed) {
    float sum = 0.0;
    float strength = 4.6207;
    for (int i = 0; i < octaves; ++i) {
        float kept = 1.0 - smoothstep(0.15, 0.6, width);
        if (kept <= 0.0) {
            break;
        }
        sum += strength * kept * noise_2(x, seed + uint(i));
        x = vec2(2.0 * x.x + x.y + 0.37, 2.0 * x.y - x.x + 0.71);
        width *= 2.23606797749979;
        strength *= 0.58;
    }
    return sum;
}

// @part perlin_3
// Gradient noise in the plane and in time (Perlin 2002: quintic fade), one cell a unit, standard deviation 0.1911. It repeats after 256
// cells, and so do the octaves: each is the last turned by 26.6 degrees in the plane and made finer by the root of 5, and twice as fast.
// docs/formulae.md, section 9.
float noise_edge(uint column, int k, vec3 way) {
    uint word = noise_hash(column ^ uint(k & 255));
    // The gradient's parts are in [0, 1023]: their middle is taken off once, from the sum.
    return dot(vec3(float(word & 1023u), float((word >> 10u) & 1023u), float((word >> 20u) & 1023u)), way) / 511.5 - (way.x + way.y + way.z);
}

float noise_side(uint row, int j, int k, vec3 way, float w_t) {
    uint column = noise_hash(row ^ uint(j & 255));
    return mix(noise_edge(column, k, way), noise_edge(column, k + 1, way - vec3(0.0, 0.0, 1.0)), w_t);
}

float noise_3(vec3 x, uint seed) {
    vec3 base = floor(x);
    vec3 t = x - base;
    vec3 w = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    ivec3 cell = as_bits(base);
    uint near = noise_hash(uint(cell.x & 255) ^ seed);
    uint far = noise_hash(uint((cell.x + 1) & 255) ^ seed);
    return mix(
        mix(noise_side(near, cell.y, cell.z, t, w.z), noise_side(far, cell.y, cell.z, t - vec3(1.0, 0.0, 0.0), w.z), w.x),
        mix(noise_side(near, cell.y + 1, cell.z, t - vec3(0.0, 1.0, 0.0), w.z),
            noise_side(far, cell.y + 1, cell.z, t - vec3(1.0, 1.0, 0.0), w.z), w.x),
        w.y);
}

// Octaves of 0.58 of the strength each, standard deviation 1 in all; each is gone before its cell is seen under 1.7 widths.
float fractal_3(vec3 x, float width, int octaves, uint seed) {
    float sum = 0.0;
    float strength = 4.2631;
    for (int i = 0; i < octaves; ++i) {
        float kept = 1.0 - smoothstep(0.15, 0.6, width);
        if (kept <= 0.0) {
            break;
        }
        sum += strength * kept * noise_3(x, seed + uint(i));
        x = vec3(2.0 * x.x + x.y + 0.37, 2.0 * x.y - x.x + 0.71, 2.0 * x.z + 0.53);
        width *= 2.23606797749979;
        strength *= 0.58;
    }
    return sum;
}

// @part slopes
// Gradient noise in the plane that never repeats (Perlin 2002: quintic fade), one cell a unit, standard deviation 1, and its gradient.
vec2 noise_way(uint column, int j) {
    uint word = noise_hash(column ^ uint(j));
    return vec2(float(word & 65535u), float(word >> 16u)) / 32767.5 - 1.0;
}

vec3 noise_slopes(uint key, vec2 x) {
    vec2 base = floor(x);
    vec2 t = x - base;
    ivec2 cell = as_int(base);
    uint near = noise_hash(uint(cell.x) ^ key);
    uint far = noise_hash(uint(cell.x + 1) ^ key);
    vec2 a = noise_way(near, cell.y);
    vec2 b = noise_way(far, cell.y);
    vec2 c = noise_way(near, cell.y + 1);
    vec2 e = noise_way(far, cell.y + 1);
    float at_a = dot(a, t);
    float at_b = dot(b, t - vec2(1.0, 0.0)) - at_a;
    float at_c = dot(c, t - vec2(0.0, 1.0)) - at_a;
    float twist = dot(e, t - vec2(1.0, 1.0)) - at_a - at_b - at_c;
    vec2 w = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    vec2 s = 30.0 * t * t * (1.0 - t) * (1.0 - t);
    // 5.672: over the standard deviation of the sum.
    return 5.672 * vec3(
        at_a + w.x * at_b + w.y * at_c + w.x * w.y * twist,
        a + w.x * (b - a) + w.y * (c - a) + w.x * w.y * (a - b - c + e) + s * vec2(at_b + w.y * twist, at_c + w.x * twist));
}

// @part slopes_3
// Gradient noise in space (Perlin 2002: quintic fade), one cell a unit, standard deviation 1, and its gradient first. It repeats after 256
// cells.
vec4 noise_slopes_3(vec3 x, uint key) {
    vec3 base = floor(x);
    vec3 t = x - base;
    vec3 w = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    vec3 s = 30.0 * t * t * (1.0 - t) * (1.0 - t);
    vec4 sum = vec4(0.0);
    ivec3 cell = as_bits(base);
    for (int i = 0; i < 2; ++i) {
        uint row = noise_hash(key ^ uint(cell.x + i & 255));
        for (int j = 0; j < 2; ++j) {
            uint column = noise_hash(row ^ uint(cell.y + j & 255));
            for (int k = 0; k < 2; ++k) {
                uint word = noise_hash(column ^ uint(cell.z + k & 255));
                vec3 way = vec3(float(word & 1023u), float((word >> 10u) & 1023u), float((word >> 20u) & 1023u)) / 511.5 - 1.0;
                vec3 far = vec3(i, j, k);
                vec3 share = mix(1.0 - w, w, far);
                float rise = dot(way, t - far);
                sum.w += share.x * share.y * share.z * rise;
                sum.xyz += share.x * share.y * share.z * way + rise * mix(-s, s, far) * share.yxx * share.zzy;
            }
        }
    }
    // Over the standard deviation of the sum.
    return 5.233 * sum;
}
