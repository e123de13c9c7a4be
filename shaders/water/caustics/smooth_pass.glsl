// The caustic map from a refracted grid drawn at half texels, as smooth as the one from photons: the cubic B-spline of a texel,
// for each colour as far beside as its light lands beside what was drawn.
uniform sampler2D u_caustic_light;
uniform vec3 u_caustic_across[CAUSTIC_TAPS]; // weights of red, green and blue, of columns and of rows of half texels
uniform vec3 u_caustic_along[CAUSTIC_TAPS];
out vec4 o_light;

void main() {
    ivec2 first = 2 * ivec2(gl_FragCoord.xy) + CAUSTIC_RIM - CAUSTIC_BEFORE;
    vec3 sum = vec3(0.0);
    for (int j = 0; j < CAUSTIC_TAPS; ++j) {
        vec3 row = vec3(0.0);
        for (int i = 0; i < CAUSTIC_TAPS; ++i) {
            row += texel_at(u_caustic_light, first + ivec2(i, j)).rgb * u_caustic_across[i];
        }
        sum += row * u_caustic_along[j];
    }
    o_light = vec4(sum, 0.0);
}
