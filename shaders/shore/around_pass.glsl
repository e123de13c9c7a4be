// The same; g: in a cell and the eight round it, where beams no wider than a cell on either side meet nothing higher; b, a: heights from
// which the sun is seen.
uniform sampler2D u_land_cells;
out vec4 o_highest;

void main() {
    ivec2 cell = ivec2(gl_FragCoord.xy);
    ivec2 level = land_level(cell.x);
    ivec2 low = ivec2(level.y, 0);
    ivec2 high = low + level.x - 1;
    float highest = 0.0;
    for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
            highest = max(highest, texelFetch(u_land_cells, clamp(cell + ivec2(i, j), low, high), 0).r);
        }
    }
    // Half floats round by less.
    vec2 sunlit = level.x == LAND_CELLS ? sunlit_from(cell) : vec2(0.0);
    o_highest = vec4(1.001 * vec2(texelFetch(u_land_cells, cell, 0).r, highest), sunlit);
}
