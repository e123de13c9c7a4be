// What a map of waves holds at most in blocks of its texels: height (m), slope, second derivative where troughs turn up (1/m).
// From its slopes' differences. docs/formulae.md, section 3.
uniform sampler2D u_bounded; // height, slopes along x and z
uniform float u_bounded_texel; // m
out vec4 o_bounds;

void main() {
    ivec2 size = textureSize(u_bounded, 0);
    ivec2 corner = ivec2(gl_FragCoord.xy) * BOUNDS_BLOCK;
    vec3 bounds = vec3(-65000.0, 0.0, 0.0);
    for (int j = 0; j < BOUNDS_BLOCK; j += BOUNDS_STRIDE) {
        for (int i = 0; i < BOUNDS_BLOCK; i += BOUNDS_STRIDE) {
            ivec2 at = (corner + ivec2(i, j)) % size;
            vec3 here = texelFetch(u_bounded, at, 0).xyz;
            vec3 along_x = texelFetch(u_bounded, ivec2((at.x + 1) % size.x, at.y), 0).xyz - here;
            vec3 along_z = texelFetch(u_bounded, ivec2(at.x, (at.y + 1) % size.y), 0).xyz - here;
            // The greater eigenvalue of the second derivatives.
            float half_sum = 0.5 * (along_x.y + along_z.z);
            float half_difference = 0.5 * (along_x.y - along_z.z);
            float mixed = 0.5 * (along_x.z + along_z.y);
            float bend = half_sum + sqrt(half_difference * half_difference + mixed * mixed);
            float steep = max(length(here.yz), length(vec2(along_x.x, along_z.x)) / u_bounded_texel);
            bounds = max(bounds, vec3(here.x, steep, bend / u_bounded_texel));
        }
    }
    o_bounds = vec4(bounds, 0.0);
}
