// How far a pixel is from what is round it: an estimate of its error. docs/formulae.md, section 1.
uniform sampler2D u_frame;
out vec4 o_contrast;

// Mean of the channels, rolled off over white: what is far over it differs little on a screen, and by many samples' means.
float roll(vec4 light) {
    float mean = (light.r + light.g + light.b) / 3.0;
    return 3.0 * mean / (2.0 + mean);
}

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(u_frame, 0) - 1;
    float here = roll(texelFetch(u_frame, at, 0));
    float cross = here;
    float sum = here;
    float squares = here * here;
    for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
            if (i != 0 || j != 0) {
                float there = roll(texelFetch(u_frame, clamp(at + ivec2(i, j), ivec2(0), last), 0));
                cross += i * j == 0 ? there : 0.0;
                sum += there;
                squares += there * there;
            }
        }
    }
    float apart = here - 0.2 * cross;
    float variance = max(squares / 9.0 - sum * sum / 81.0, 0.0);
    o_contrast = vec4(sqrt(apart * apart + 0.5 * variance), 0.0, 0.0, 1.0);
}
