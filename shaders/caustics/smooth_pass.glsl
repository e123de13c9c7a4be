// The caustic map from a refracted grid, as smooth as the one from photons: the cubic B-spline at the texels, 1/6, 2/3, 1/6.
uniform sampler2D u_caustic_red;
uniform sampler2D u_caustic_green;
uniform sampler2D u_caustic_blue;
out vec4 o_light;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy) + CAUSTIC_RIM;
    vec3 sum = vec3(0.0);
    for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
            ivec2 from = at + ivec2(i, j);
            vec3 light = vec3(
                texelFetch(u_caustic_red, from, 0).r,
                texelFetch(u_caustic_green, from, 0).r,
                texelFetch(u_caustic_blue, from, 0).r);
            sum += light * float((i == 0 ? 4 : 1) * (j == 0 ? 4 : 1)) / 36.0;
        }
    }
    o_light = vec4(sum, 0.0);
}
