// The greatest of all blocks.
uniform sampler2D u_blocks;
out vec4 o_bounds;

void main() {
    ivec2 size = textureSize(u_blocks, 0);
    vec3 bounds = vec3(-65000.0, 0.0, 0.0);
    for (int j = 0; j < size.y; ++j) {
        for (int i = 0; i < size.x; ++i) {
            bounds = max(bounds, texel_at(u_blocks, ivec2(i, j)).xyz);
        }
    }
    // A little more: texels are read bilinearly, and half floats are rounded.
    o_bounds = min(vec4(bounds.x + 1e-3 * abs(bounds.x), 1.02 * bounds.y, 1.1 * bounds.z, 0.0), 65000.0);
}
