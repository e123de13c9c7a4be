// No shadows of land.
vec2 sunlit_from(ivec2 cell) {
    return vec2(0.0);
}
