// How high land stands at most in the cells of a tree over the square: LAND_CELLS of them along a side, and half as many a level,
// level by level side by side. From the texels that its B-spline reads there, which it never passes.
uniform sampler2D u_shore_floor; // height (m), tint
out vec4 o_highest;

void main() {
    ivec2 cell = ivec2(gl_FragCoord.xy);
    int cells = LAND_CELLS;
    while (cells > 1 && cell.x >= cells) {
        cell.x -= cells;
        cells >>= 1;
    }
    o_highest = vec4(0.0);
    if (cells < LAND_COARSEST || cell.y >= cells) {
        return;
    }
    int side = FLOOR_TEXELS / cells;
    float highest = 0.0;
    for (int j = -1; j <= side; ++j) {
        for (int i = -1; i <= side; ++i) {
            ivec2 texel = clamp(side * cell + ivec2(i, j), ivec2(0), ivec2(FLOOR_TEXELS - 1));
            highest = max(highest, texelFetch(u_shore_floor, texel, 0).r);
        }
    }
    o_highest = vec4(highest, 0.0, 0.0, 0.0);
}
