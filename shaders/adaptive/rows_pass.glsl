// Chosen pixels in the rows of cells under this one (xy), and in these and itself (zw).
uniform sampler2D u_chosen_groups;
out vec4 o_row;

void main() {
    int row = int(gl_FragCoord.y);
    int last = textureSize(u_chosen_groups, 0).x - 1;
    vec2 before = vec2(0.0);
    for (int y = 0; y < row; ++y) {
        before += texelFetch(u_chosen_groups, ivec2(last, y), 0).zw;
    }
    o_row = vec4(before, before + texelFetch(u_chosen_groups, ivec2(last, row), 0).zw);
}
