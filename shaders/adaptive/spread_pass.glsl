// Points, which are soft and a sample wide at least, were drawn over the whole picture: they are laid over a chosen pixel's samples.
uniform sampler2D u_points;
out vec4 o_color;

void main() {
    o_color = texelFetch(u_points, ivec2(sample_place() * (float(SAMPLE_SIDE) / u_chosen.x)), 0);
}
