// Corners of one triangle on one side of the horizon. Rays fall on one side of a line: u_ray_z.y + dot(steep, place) < 0 in clip space.
uniform float u_surface_top;

// Whether the eye stands above every crest, so that a rising ray meets no water, and sees where rays begin to fall.
bool over_crests() {
    return u_eye_height >= u_surface_top && length(vec2(u_ray_x.y, u_ray_y.y)) > 1e-6;
}

// side: 1 under the horizon, -1 over it. Two samples on the other side of the line are covered too, whatever rounding does.
vec2 horizon_corner(float side) {
    vec2 steep = vec2(u_ray_x.y, u_ray_y.y);
    float slope = length(steep);
    vec2 inward = -side / slope * steep;
    vec2 middle = clamp(side * u_ray_z.y / slope - 4.0 / min(u_viewport.x, u_viewport.y), -1.5, 1.5) * inward;
    // The target's corners are within 3 of there, where the triangle is 6 wide to either side.
    vec2 along = 12.0 * vec2(-inward.y, inward.x);
    return gl_VertexID == 0 ? middle - along : gl_VertexID == 1 ? middle + along : middle + 6.0 * inward;
}
