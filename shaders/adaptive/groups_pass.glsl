// Chosen pixels in the groups before this one in the row of cells (xy), and in these and itself (zw).
uniform sampler2D u_chosen_cells;
out vec4 o_group;

vec2 group_total(int group, int y) {
    vec4 last = texelFetch(u_chosen_cells, ivec2(min(16 * group + 15, textureSize(u_chosen_cells, 0).x - 1), y), 0);
    return last.zw + bits(last.xy);
}

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec2 before = vec2(0.0);
    for (int x = 0; x < at.x; ++x) {
        before += group_total(x, at.y);
    }
    o_group = vec4(before, before + group_total(at.x, at.y));
}
