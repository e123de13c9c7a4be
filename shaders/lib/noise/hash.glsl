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
