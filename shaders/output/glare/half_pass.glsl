// The next level, half as fine: weights 1, 3, 3, 1 along both axes.
uniform sampler2D u_finer;
out vec4 o_color;

void main() {
    o_color = vec4(taps(u_finer, 2.0 * gl_FragCoord.xy, 0.75), 0.0);
}
