// The greatest of all blocks.
uniform sampler2D u_blocks;
out vec4 o_bounds;

void main() {
    ivec2 size = textureSize(u_blocks, 0);
    vec3 bounds = vec3(-1e9, 0.0, 0.0);
    for (int j = 0; j < size.y; ++j) {
        for (int i = 0; i < size.x; ++i) {
            bounds = max(bounds, texelFetch(u_blocks, ivec2(i, j), 0).xyz);
        }
    }
    // Between texels, which are read bilinearly, a little more.
    o_bounds = vec4(bounds.x, 1.02 * bounds.y, 1.1 * bounds.z, 0.0);
}
