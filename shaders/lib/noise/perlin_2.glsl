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
    ivec2 cell = ivec2(base);
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
