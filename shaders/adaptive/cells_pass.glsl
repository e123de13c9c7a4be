// The chosen pixels of a cell of 4 x 4: x, those of 4 samples, y, those of 16; a bit each, rows from below.
uniform sampler2D u_contrast;
uniform sampler2D u_limit;
out vec4 o_cell;

void main() {
    ivec2 picture = textureSize(u_contrast, 0);
    ivec2 first = 4 * ivec2(gl_FragCoord.xy);
    float limit = texelFetch(u_limit, ivec2(0), 0).z;
    int few = 0;
    int many = 0;
    for (int bit = 0; bit < 16; ++bit) {
        ivec2 at = first + ivec2(bit & 3, bit >> 2);
        if (all(lessThan(at, picture))) {
            int found = choice(texelFetch(u_contrast, at, 0).x, limit, picture);
            few |= (found & 1) << bit;
            many |= (found >> 1) << bit;
        }
    }
    o_cell = vec4(few, many, 0.0, 0.0);
}
