// Gaussian smoothing along one side of the map.
uniform vec2 u_viewport;
uniform sampler2D u_rough;
uniform vec2 u_blur_side;     // (1, 0) or (0, 1)
uniform float u_shore_spread; // standard deviation, texels, at most SPREAD_REACH/3
out vec4 o_smooth;

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(u_rough, 0) - 1;
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int i = -SPREAD_REACH; i <= SPREAD_REACH; ++i) {
        // No smoothing at all is a Gaussian of a hundredth of a texel: 0/0 is kept out.
        float x = float(i) / max(u_shore_spread, 0.01);
        float weight = exp(-0.5 * min(x * x, 160.0));
        sum += weight * texelFetch(u_rough, clamp(here + i * ivec2(u_blur_side), ivec2(0), last), 0);
        weights += weight;
    }
    o_smooth = sum / weights;
}
