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
    ivec2 cell = ivec2(base);
    return mix(
        mix(noise_corner(key, cell), noise_corner(key, cell + ivec2(1, 0)), t.x),
        mix(noise_corner(key, cell + ivec2(0, 1)), noise_corner(key, cell + ivec2(1, 1)), t.x), t.y);
}
