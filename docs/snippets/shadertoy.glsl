// Shadertoy: a wave, its foam saturation and a mask, antialiased. iChannel0: the texture "Blue Noise", filter mipmap, wrap repeat.
const float TEXELS_A_METRE = 24.0;
// Thresholds in a texel of a coarser level lie about so far from their mean.
const float SPREAD = 0.49;

float foam(float saturation, vec2 at) { // at: texels
    vec2 dx = dFdx(at), dy = dFdy(at);
    float side = 0.25 * sqrt(abs(dx.x * dy.y - dx.y * dy.x));
    int level = int(clamp(floor(log2(max(side, 1e-6)) + 0.5), 0.0, 10.0));
    float tilt = clamp(6.0 * (level > 0 ? SPREAD : 0.0) - 1.5, 0.0, 1.0), bend = 6.0 * saturation * (1.0 - saturation), covered = 0.0;
    for (int i = 0; i < 16; i++) {
        vec2 place = at + dx * (float(i & 3) - 1.5) / 4.0 + dy * (float(i >> 2) - 1.5) / 4.0;
        ivec2 size = textureSize(iChannel0, level);
        ivec2 texel = ivec2(floor(mod(place / exp2(float(level)), vec2(size))));
        float mean = texelFetch(iChannel0, min(texel, size - 1), level).r * (255.0 / 256.0) + 0.5 / 256.0;
        float spread = max(min((level > 0 ? SPREAD : 0.0), min(mean, 1.0 - mean)), 1e-6);
        float even = clamp(0.5 + 0.5 * (saturation - mean) / spread, 0.0, 1.0);
        covered += mix(even, clamp(saturation - bend * (mean - 0.5), 0.0, 1.0), tilt);
    }
    return covered / 16.0;
}

void mainImage(out vec4 colour, in vec2 pixel) {
    // A camera 3 m above the water, which looks down a little.
    vec2 screen = (pixel - 0.5 * iResolution.xy) / iResolution.y;
    vec3 ray = normalize(vec3(screen.x, screen.y - 0.35, 1.2));
    vec2 place = ray.xz * 3.0 / max(-ray.y, 1e-3);
    // The paper's saturation behind a crest: e^cot(theta / 2) / 4. Its poles at 0 and 2 pi are kept out at both ends.
    float phase = 0.9 * place.y + 0.2 * place.x - 2.0 * iTime;
    float theta = clamp(mod(phase, 6.2831853), 1e-3, 6.2821853);
    float saturation = clamp(exp(min(1.0 / tan(0.5 * theta), 4.0)) / 4.0, 0.0, 1.0);
    vec3 water = mix(vec3(0.01, 0.06, 0.09), vec3(0.10, 0.26, 0.32), 0.5 + 0.5 * sin(phase));
    vec3 lit = mix(water, vec3(0.92), foam(saturation, place * TEXELS_A_METRE));
    colour = vec4(ray.y < -1e-3 ? mix(lit, vec3(0.62, 0.74, 0.82), exp(-8.0 * -ray.y)) : vec3(0.62, 0.74, 0.82), 1.0);
}
