// The pixel that a block of samples belongs to: the n-th that was chosen, found from row to group, cell and bit.
uniform sampler2D u_chosen_cells;
uniform sampler2D u_chosen_groups;
uniform sampler2D u_chosen_rows;
uniform vec2 u_picture; // pixels
out vec4 o_pixel;

void main() {
    int rows = textureSize(u_chosen_rows, 0).y;
    int columns = chosen_columns(int(u_picture.x));
    float n = floor(gl_FragCoord.y) * float(columns) + floor(gl_FragCoord.x);
    // Past the last one: the last one once more.
    n = min(n, chosen_total(texelFetch(u_chosen_rows, ivec2(0, rows - 1), 0).zw) - 1.0);

    int low = 0;
    int high = rows - 1;
    while (low < high) {
        int middle = (low + high) >> 1;
        bool after = chosen_total(texelFetch(u_chosen_rows, ivec2(0, middle), 0).zw) <= n;
        low = after ? middle + 1 : low;
        high = after ? high : middle;
    }
    int row = low;
    n -= chosen_total(texelFetch(u_chosen_rows, ivec2(0, row), 0).xy);

    low = 0;
    high = textureSize(u_chosen_groups, 0).x - 1;
    while (low < high) {
        int middle = (low + high) >> 1;
        bool after = chosen_total(texelFetch(u_chosen_groups, ivec2(middle, row), 0).zw) <= n;
        low = after ? middle + 1 : low;
        high = after ? high : middle;
    }
    n -= chosen_total(texelFetch(u_chosen_groups, ivec2(low, row), 0).xy);

    // The last cell that has no more than n before it.
    high = min(16 * low + 15, textureSize(u_chosen_cells, 0).x - 1);
    low = 16 * low;
    while (low < high) {
        int middle = (low + high + 1) >> 1;
        bool before = chosen_total(texelFetch(u_chosen_cells, ivec2(middle, row), 0).zw) <= n;
        low = before ? middle : low;
        high = before ? high : middle - 1;
    }
    vec4 cell = texelFetch(u_chosen_cells, ivec2(low, row), 0);
    int left = int(n - chosen_total(cell.zw));
    int mask = int(chosen_total(cell.xy));
    for (int k = 0; k < left; ++k) {
        mask &= mask - 1;
    }
    int bit = bits((mask & -mask) - 1);
    o_pixel = vec4(4 * low + (bit & 3), 4 * row + (bit >> 2), 0.0, 1.0);
}
