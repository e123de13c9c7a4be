// Mean of SAMPLE_SIDE x SAMPLE_SIDE samples, in linear light.
uniform sampler2D u_samples;
out vec4 o_color;

void main() {
    ivec2 corner = ivec2(gl_FragCoord.xy) * SAMPLE_SIDE;
    vec4 sum = vec4(0.0);
    for (int j = 0; j < SAMPLE_SIDE; ++j) {
        for (int i = 0; i < SAMPLE_SIDE; ++i) {
            sum += texelFetch(u_samples, corner + ivec2(i, j), 0);
        }
    }
    o_color = sum / float(SAMPLE_SIDE * SAMPLE_SIDE);
}
