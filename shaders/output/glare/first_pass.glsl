// What spreads of the finished frame: means of 4 x 4 pixels. docs/formulae.md, section 7.
uniform sampler2D u_frame;
out vec4 o_color;

// Light that a sum of levels still holds in a half float; a pixel so bright is white at any exposure.
const float GLARE_MOST = 4096.0;

void main() {
    ivec2 last = textureSize(u_frame, 0) - 1;
    ivec2 corner = ivec2(gl_FragCoord.xy) * 4;
    vec3 sum = vec3(0.0);
    for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
            sum += min(texelFetch(u_frame, min(corner + ivec2(i, j), last), 0).rgb, GLARE_MOST);
        }
    }
    o_color = vec4(sum / 16.0, 0.0);
}
