// A tile as footprints see it, twice as fine: slopes, their square, divergence. Between its texels by the B-spline; the levels below it
// are means over more and more of them.
uniform sampler2D u_sea_full;
out vec4 o_seen;

void main() {
    vec4 here = sea_smooth(u_sea_full, floor(gl_FragCoord.xy) / float(2 * SEA_SIZE));
    o_seen = vec4(here.yz, dot(here.yz, here.yz), here.w);
}
