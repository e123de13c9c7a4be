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
    ivec2 at = ivec2(gl_FragCoord.xy);
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
