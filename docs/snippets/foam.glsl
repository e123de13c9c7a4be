// Antialiased halftone foam with one mask, for GLSL 3.30 and GLSL ES 3.00: sixteen taps over the pixel's footprint.
// u_mask: GL_R16 or a float texture of v / 65535, with all mipmaps; filters GL_NEAREST and GL_NEAREST_MIPMAP_NEAREST, GL_REPEAT.
uniform highp sampler2D u_mask;

// How far thresholds lie from their mean in a texel of each level: sqrt(3) times the mask's sigma_l. Where that is nearly
// 1/2, as of all thresholds, those of a texel are spread over 0 to 1 and tilted toward their mean: no coverage is lost.
const float SPREAD[11] = float[11](0.0, 0.404, 0.471, 0.493, 0.499, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5);

// Share of the pixel that foam covers. saturation: 0 to 1; uv: counts repeats of the mask.
float foam(float saturation, vec2 uv) {
    vec2 dx = dFdx(uv), dy = dFdy(uv), size = vec2(textureSize(u_mask, 0));
    // A quarter of the footprint's side, in texels, is a tap's.
    float side = 0.25 * sqrt(abs(dx.x * dy.y - dx.y * dy.x) * size.x * size.y);
    int level = int(clamp(floor(log2(max(side, 1e-6)) + 0.5), 0.0, 10.0));
    float tilt = clamp(6.0 * SPREAD[level] - 1.5, 0.0, 1.0), bend = 6.0 * saturation * (1.0 - saturation), covered = 0.0;
    for (int i = 0; i < 16; i++) {
        vec2 at = uv + dx * (float(i & 3) - 1.5) / 4.0 + dy * (float(i >> 2) - 1.5) / 4.0;
        float mean = textureLod(u_mask, at, float(level)).r * (65535.0 / 65536.0) + 0.5 / 65536.0;
        float spread = max(min(SPREAD[level], min(mean, 1.0 - mean)), 1e-6);
        float even = clamp(0.5 + 0.5 * (saturation - mean) / spread, 0.0, 1.0);
        covered += mix(even, clamp(saturation - bend * (mean - 0.5), 0.0, 1.0), tilt);
    }
    return covered / 16.0;
}
