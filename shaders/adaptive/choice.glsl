// What a pixel of this contrast gets from a limit on: nothing (0), 4 samples (1) or 16 (2). docs/formulae.md, section 1.
int choice(float contrast, float limit, ivec2 picture) {
    // Blocks of 16 samples leave gaps in small targets.
    bool many = CHOOSE_MANY && min(picture.x, picture.y) >= 24 && contrast > (CHOOSE_FEW ? CHOOSE_RATIO : 1.0) * limit;
    return many ? 2 : CHOOSE_FEW && contrast > limit ? 1 : 0;
}
