// Gradient noise in the plane and in time (Perlin 2002: quintic fade), one cell a unit, standard deviation 0.1911. It repeats after 256
// cells, and so do the octaves: each is the last turned by 26.6 degrees in the plane and made finer by the root of 5, and twice as fast.
// docs/formulae.md, section 9.
float noise_edge(uint column, int k, vec3 way) {
    uint word = noise_hash(column ^ uint(k & 255));
    return dot(vec3(float(word & 1023u), float((word >> 10u) & 1023u), float((word >> 20u) & 1023u)) / 511.5 - 1.0, way);
}

float noise_side(uint row, int j, int k, vec3 way, float w_t) {
    uint column = noise_hash(row ^ uint(j & 255));
    return mix(noise_edge(column, k, way), noise_edge(column, k + 1, way - vec3(0.0, 0.0, 1.0)), w_t);
}

float noise_3(vec3 x, uint seed) {
    vec3 base = floor(x);
    vec3 t = x - base;
    vec3 w = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    ivec3 cell = ivec3(base);
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
