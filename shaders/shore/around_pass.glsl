// The same; g: in a cell and the eight round it, where beams no wider than a cell on either side meet nothing higher.
uniform sampler2D u_land_cells;
out vec4 o_highest;

void main() {
    ivec2 cell = ivec2(gl_FragCoord.xy);
    int left = 0;
    int cells = LAND_CELLS;
    while (cells > 1 && cell.x >= left + cells) {
        left += cells;
        cells >>= 1;
    }
    ivec2 low = ivec2(left, 0);
    ivec2 high = ivec2(left, 0) + cells - 1;
    float highest = 0.0;
    for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
            highest = max(highest, texelFetch(u_land_cells, clamp(cell + ivec2(i, j), low, high), 0).r);
        }
    }
    // Half floats round by less.
    o_highest = 1.001 * vec4(texelFetch(u_land_cells, cell, 0).r, highest, 0.0, 0.0);
}
