// The list of chosen pixels, from groups to rows, and their samples added to the picture.

// @part within
// The cell's bits, and zw: how many pixels are chosen in the cells before it in its group of 16 along the row.
uniform sampler2D u_choice;
out vec4 o_cell;

void main() {
    ivec2 at = as_int(floor(gl_FragCoord.xy));
    vec2 before = vec2(0.0);
    for (int x = at.x & ~15; x < at.x; ++x) {
        before += bits(texelFetch(u_choice, ivec2(x, at.y), 0).xy);
    }
    o_cell = vec4(texelFetch(u_choice, at, 0).xy, before);
}

// @part groups
// Chosen pixels in the groups before this one in the row of cells (xy), and in these and itself (zw).
uniform sampler2D u_chosen_cells;
out vec4 o_group;

vec2 group_total(int group, int y) {
    vec4 last = texelFetch(u_chosen_cells, ivec2(min(16 * group + 15, textureSize(u_chosen_cells, 0).x - 1), y), 0);
    return last.zw + bits(last.xy);
}

void main() {
    ivec2 at = as_int(floor(gl_FragCoord.xy));
    vec2 before = vec2(0.0);
    for (int x = 0; x < at.x; ++x) {
        before += group_total(x, at.y);
    }
    o_group = vec4(before, before + group_total(at.x, at.y));
}

// @part cells
// The chosen pixels of a cell of 4 x 4: x, those of 4 samples, y, those of 16; a bit each, rows from below.
uniform sampler2D u_contrast;
uniform sampler2D u_limit;
out vec4 o_cell;

void main() {
    ivec2 picture = textureSize(u_contrast, 0);
    ivec2 first = 4 * as_int(floor(gl_FragCoord.xy));
    float limit = texelFetch(u_limit, ivec2(0), 0).z;
    int few = 0;
    int many = 0;
    for (int bit = 0; bit < 16; ++bit) {
        ivec2 at = first + ivec2(bit & 3, bit >> 2);
        if (all(lessThan(at, picture))) {
            int found = choice(texelFetch(u_contrast, at, 0).x, limit, picture);
            few |= (found & 1) << bit;
            many |= (found >> 1) << bit;
        }
    }
    o_cell = vec4(few, many, 0.0, 0.0);
}

// @part rows
// Chosen pixels in the rows of cells under this one (xy), and in these and itself (zw).
uniform sampler2D u_chosen_groups;
out vec4 o_row;

void main() {
    int row = as_int(floor(gl_FragCoord.y));
    int last = textureSize(u_chosen_groups, 0).x - 1;
    vec2 before = vec2(0.0);
    for (int y = 0; y < row; ++y) {
        before += texelFetch(u_chosen_groups, ivec2(last, y), 0).zw;
    }
    o_row = vec4(before, before + texelFetch(u_chosen_groups, ivec2(last, row), 0).zw);
}

// @part rows_vertex
// One triangle over those rows of the target that chosen pixels fill, and over no other. docs/formulae.md, section 1.
uniform sampler2D u_chosen_rows;
uniform vec2 u_picture; // pixels
uniform vec2 u_target;  // pixels

void main() {
    float blocks = chosen_total(texelFetch(u_chosen_rows, ivec2(0, textureSize(u_chosen_rows, 0).y - 1), 0).zw);
    float columns = float(chosen_columns(int(u_picture.x)));
    float filled = 2.0 * ceil(blocks / columns) * u_chosen.y / u_target.y - 1.0;
    vec2 corner = gl_VertexID == 0 ? vec2(-9.0, filled) : gl_VertexID == 1 ? vec2(9.0, filled) : vec2(0.0, -9.0);
    gl_Position = vec4(corner.x, corner.y * u_chosen.z, FULLSCREEN_DEPTH, 1.0);
}

// @part pixels
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

// @part resolve
// The finished frame: means of the samples of chosen pixels, in linear light; all others as they were.
uniform sampler2D u_frame;
uniform sampler2D u_samples;
uniform sampler2D u_chosen_cells;
uniform sampler2D u_chosen_groups;
uniform sampler2D u_chosen_rows;
out vec4 o_color;

// Mean of side x side samples of the n-th block of its kind.
vec4 block_mean(int n, int side, int columns, int height) {
    // Integers are slow to divide: by floats, whose rounding may miss by one in the largest pictures.
    int row = int((float(n) + 0.5) / float(columns));
    row += n < row * columns ? -1 : n >= (row + 1) * columns ? 1 : 0;
    ivec2 corner = side * ivec2(n - row * columns, row);
    vec4 sum = vec4(0.0);
    for (int j = 0; j < side; ++j) {
        for (int i = 0; i < side; ++i) {
            ivec2 at = corner + ivec2(i, j);
            sum += texelFetch(u_samples, ivec2(at.x, side == 4 ? height - 1 - at.y : at.y), 0);
        }
    }
    return sum / float(side * side);
}

void main() {
    ivec2 at = as_int(floor(gl_FragCoord.xy));
    ivec2 size = textureSize(u_samples, 0);
    ivec2 cell = at >> 2;
    vec4 found = texelFetch(u_chosen_cells, cell, 0);
    int bit = 1 << (4 * (at.y & 3) + (at.x & 3));
    bool few = (int(found.x) & bit) != 0;
    bool many = (int(found.y) & bit) != 0;
    o_color = texelFetch(u_frame, at, 0);
    if (few || many) {
        vec4 before = texelFetch(u_chosen_groups, ivec2(cell.x >> 4, cell.y), 0) + texelFetch(u_chosen_rows, ivec2(0, cell.y), 0);
        vec2 ranks = before.xy + found.zw + bits(vec2(ivec2(found.xy) & (bit - 1)));
        o_color = block_mean(int(many ? ranks.y : ranks.x), many ? 4 : 2, many ? size.x >> 2 : size.x >> 1, size.y);
    }
}
