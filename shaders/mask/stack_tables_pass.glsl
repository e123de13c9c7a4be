// Tables of several masks over one another, the youngest foam's first: an entry and the next.
uniform sampler2D u_mask_table_0;
uniform sampler2D u_mask_table_1;
uniform sampler2D u_mask_table_2; // where there are two masks, the second once more
out vec4 o_table;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    int which = at.y / MASK_ROWS;
    at.y -= which * MASK_ROWS;
    vec2 entry = which == 0 ? texelFetch(u_mask_table_0, at, 0).rg
        : which == 1 ? texelFetch(u_mask_table_1, at, 0).rg
        : texelFetch(u_mask_table_2, at, 0).rg;
    o_table = vec4(entry, 0.0, 0.0);
}
