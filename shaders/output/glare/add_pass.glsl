// A coarser level with all that were added to it, onto the next finer one.
uniform sampler2D u_coarser;
out vec4 o_color;

void main() {
    float share = level_share(float(textureSize(u_coarser, 0).y));
    o_color = vec4(share * taps(u_coarser, 0.5 * gl_FragCoord.xy, 0.5), 0.0);
}
