// The caustic map from a refracted grid drawn at half texels, as smooth as the one from photons: the cubic B-spline of a texel.
uniform sampler2D u_caustic_light;
out vec4 o_light;

// At 1/4, 3/4 and 5/4 of a texel to either side; what is left at 7/4, 0.26 %, is shared out.
const float CAUSTIC_WEIGHTS[6] = float[6](0.03524, 0.15798, 0.30678, 0.30678, 0.15798, 0.03524);

void main() {
    ivec2 at = 2 * ivec2(gl_FragCoord.xy) + CAUSTIC_RIM - 2;
    vec3 sum = vec3(0.0);
    for (int j = 0; j < 6; ++j) {
        for (int i = 0; i < 6; ++i) {
            sum += texelFetch(u_caustic_light, at + ivec2(i, j), 0).rgb * (CAUSTIC_WEIGHTS[i] * CAUSTIC_WEIGHTS[j]);
        }
    }
    o_light = vec4(sum, 0.0);
}
