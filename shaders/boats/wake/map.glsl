// Wakes read from the map that the frame drew: a band of rows a boat, along the course behind its bow and to one side.
uniform vec4 u_wake[BOAT_COUNT]; // k (rad/m), height (m), length (m), shortest waves (rad/m)
uniform sampler2D u_wake_map;

vec4 wake_here(int i, vec2 at) {
    vec2 share = vec2(at.x / max(u_wake[i].z, 1e-3), at.y / max(WAKE_ASIDE * u_wake[i].z, 1e-3));
    if (share.x <= 0.0 || share.x >= 1.0 || share.y >= 1.0) {
        return vec4(0.0);
    }
    float rows = float(WAKE_SIZE / 2);
    // Half a texel inside its band, so that no boat's wake shows in another's.
    float row = clamp(share.y * rows, 0.5, rows - 0.5) + rows * float(i);
    return textureLod(u_wake_map, vec2(share.x, row / (rows * float(BOAT_COUNT))), 0.0);
}
