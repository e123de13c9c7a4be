// The caustic map from photons: four sums a colour, and what they left on the rim belongs to the tile's other side.
uniform sampler2D u_caustic_red;
uniform sampler2D u_caustic_green;
uniform sampler2D u_caustic_blue;
out vec4 o_light;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec3 sum = vec3(0.0);
    for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
            ivec2 from = at + CAUSTIC_RIM + ivec2(i, j) * CAUSTIC_TEXELS;
            if (all(greaterThanEqual(from, ivec2(0))) && all(lessThan(from, ivec2(CAUSTIC_TEXELS + 2 * CAUSTIC_RIM)))) {
                sum.r += dot(texel_at(u_caustic_red, from), vec4(1.0));
                sum.g += dot(texel_at(u_caustic_green, from), vec4(1.0));
                sum.b += dot(texel_at(u_caustic_blue, from), vec4(1.0));
            }
        }
    }
    o_light = vec4(sum, 0.0);
}
