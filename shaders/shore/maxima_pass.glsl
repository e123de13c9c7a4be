// How high land stands at most in the cells of the tree. From the texels that its B-spline reads in a cell and a little beyond its
// walls, which it never passes.
uniform sampler2D u_shore_floor; // height (m), tint
out vec4 o_highest;

void main() {
    ivec2 cell = ivec2(gl_FragCoord.xy);
    ivec2 level = land_level(cell.x);
    cell.x -= level.y;
    o_highest = vec4(0.0);
    if (level.x < LAND_COARSEST || cell.y >= level.x) {
        return;
    }
    int side = FLOOR_TEXELS / level.x;
    float highest = 0.0;
    for (int j = -2; j <= side + 1; ++j) {
        for (int i = -2; i <= side + 1; ++i) {
            ivec2 texel = clamp(side * cell + ivec2(i, j), ivec2(0), ivec2(FLOOR_TEXELS - 1));
            highest = max(highest, texelFetch(u_shore_floor, texel, 0).r);
        }
    }
    o_highest = vec4(highest, 0.0, 0.0, 0.0);
}
