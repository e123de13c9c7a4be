// Value noise on a hash of whole numbers (PCG, O'Neill 2014): the same on every driver.
float wake_hash(ivec2 cell) {
    uint word = 0x9E3779B9u;
    for (int i = 0; i < 3; ++i) {
        uint state = (i == 0 ? word : word ^ uint(i == 1 ? cell.x : cell.y)) * 747796405u + 2891336453u;
        uint mixed = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
        word = (mixed >> 22u) ^ mixed;
    }
    return float(word >> 8u) / 16777216.0;
}

// Value noise in [0, 1], one cell a unit.
float wake_noise(vec2 x) {
    vec2 base = floor(x);
    vec2 t = x - base;
    t = t * t * (3.0 - 2.0 * t);
    ivec2 cell = ivec2(base);
    return mix(
        mix(wake_hash(cell), wake_hash(cell + ivec2(1, 0)), t.x),
        mix(wake_hash(cell + ivec2(0, 1)), wake_hash(cell + ivec2(1, 1)), t.x), t.y);
}
