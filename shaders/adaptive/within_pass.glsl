// The cell's bits, and zw: how many pixels are chosen in the cells before it in its group of 16 along the row.
uniform sampler2D u_choice;
out vec4 o_cell;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec2 before = vec2(0.0);
    for (int x = at.x & ~15; x < at.x; ++x) {
        before += bits(texelFetch(u_choice, ivec2(x, at.y), 0).xy);
    }
    o_cell = vec4(texelFetch(u_choice, at, 0).xy, before);
}
