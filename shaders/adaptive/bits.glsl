// How many of the lower 16 bits are set.
int bits(int x) {
    x -= (x >> 1) & 0x5555;
    x = (x & 0x3333) + ((x >> 2) & 0x3333);
    x = (x + (x >> 4)) & 0x0f0f;
    return (x + (x >> 8)) & 0x1f;
}

vec2 bits(vec2 both) {
    return vec2(bits(int(both.x)), bits(int(both.y)));
}
