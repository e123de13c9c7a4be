// The greatest of a wake's blocks: a row a boat; a column for what lies so many of its lengths from its middle, and further.
uniform sampler2D u_wake_blocks;
out vec4 o_bounds;

void main() {
    ivec2 size = textureSize(u_wake_blocks, 0);
    int i = int(gl_FragCoord.y);
    int rows = size.y / BOAT_COUNT;
    // On a wedge no wider than its way behind the bow a place is that way from it at least; the bow is within a length of the middle.
    float least = (float(WAKE_AWAY[int(gl_FragCoord.x)]) - 1.0) * u_wake_boat[i].x / (1.0 + WAKE_ASIDE);
    int first = clamp(int(floor(least / u_wake[i].z * float(size.x))) - 1, 0, size.x);
    vec3 bounds = vec3(0.0);
    for (int y = i * rows; y < (i + 1) * rows; ++y) {
        for (int x = first; x < size.x; ++x) {
            bounds = max(bounds, texel_at(u_wake_blocks, ivec2(x, y)).xyz);
        }
    }
    // A little more: texels are read bilinearly, which at the bow they hardly resolve, and half floats are rounded.
    float bent = gl_FragCoord.x < 1.0 ? 2.0 : 1.2;
    o_bounds = vec4(min(vec3(1.01, 1.05, bent) * bounds, 65000.0), 0.0);
}
