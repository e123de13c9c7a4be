// Corners of one triangle on one side of a line: u_ray_z.y + dot(steep, place) < water_rise() in clip space for all rays that may come to
// water. From over all crests it is the horizon.

// side: 1 under the line, -1 over it. Where all rays are under it, the first covers the target and the second nothing of it. Two samples on
// the other side of the line are covered too, whatever rounding does.
vec2 horizon_corner(float side) {
    vec2 steep = vec2(u_ray_x.y, u_ray_y.y);
    float slope = max(length(steep), 1e-9);
    bool parted = slope > 1e-6;
    vec2 inward = parted ? -side / slope * steep : vec2(0.0, 1.0);
    float begins = side * (u_ray_z.y - water_rise()) / slope - 4.0 / min(u_viewport.x, u_viewport.y);
    vec2 middle = (parted ? clamp(begins, -1.5, 1.5) : -1.5 * side) * inward;
    // The target's corners are within 3 of there, where the triangle is 6 wide to either side.
    vec2 along = 12.0 * vec2(-inward.y, inward.x);
    return gl_VertexID == 0 ? middle - along : gl_VertexID == 1 ? middle + along : middle + 6.0 * inward;
}
