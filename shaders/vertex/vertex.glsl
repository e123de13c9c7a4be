// Vertices: a triangle over the target, parts of it over or under the horizon, a square, the polar grid.

// @part fullscreen
// One triangle that covers the target, at depth FULLSCREEN_DEPTH in clip space.
void main() {
    vec2 corner = vec2(float((gl_VertexID & 1) << 2), float((gl_VertexID & 2) << 1));
    gl_Position = vec4(corner - 1.0, FULLSCREEN_DEPTH, 1.0);
}

// @part quad
// Corner of a quadrilateral of two triangles that gl_VertexID names: right and up are 1, left and down -1.
vec2 quad_corner() {
    int corner = gl_VertexID % 6;
    return vec2(corner == 1 || corner == 4 || corner == 5 ? 1.0 : -1.0, corner == 2 || corner == 3 || corner == 5 ? 1.0 : -1.0);
}

// @part side
// What place_corner places, from an eye on one side of the water; from the other it lies outside the picture. Drivers without branches
// would shade every sample for both.
void main() {
    place_corner();
    if ((u_eye_height >= waves(vec2(0.0)).x) != FROM_OVER) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    }
}

// @part horizon
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

// @part rise
// Rays of the picture that rise faster than this, m a unit, come to no water: from over it, since crests rise no steeper than the surface
// and no higher than its top. docs/formulae.md, section 3.
uniform float u_surface_top;
uniform float u_surface_grain; // what maps may add to the surface between their texels, m

float water_rise() {
    float top = min(surface_top_now(), u_surface_top) + u_surface_grain;
    float under_top = top - u_eye_height;
    float over_water = u_eye_height - waves(vec2(0.0)).x;
    if (over_water < 0.0) {
        return 1e9;
    }
    float steepest = surface_now().x * max(under_top, 0.0) / max(under_top + max(over_water - u_surface_grain, 0.0), 1e-6);
    return steepest * (length(u_ray_x.xz) + length(u_ray_y.xz) + length(u_ray_z.xz));
}

// @part rise_level
// Over level water no ray that rises comes to it.
float water_rise() {
    return u_eye_height >= 0.0 ? 0.0 : 1e9;
}

// @part falling
// One triangle, at depth FULLSCREEN_DEPTH in clip space, over all that a ray to water goes through. Drivers without branches would shade
// the sky as water, to throw it away.
void main() {
    gl_Position = vec4(horizon_corner(1.0), FULLSCREEN_DEPTH, 1.0);
}

// @part rising
// One triangle, at depth FULLSCREEN_DEPTH in clip space, over what falling.glsl leaves.
void main() {
    gl_Position = vec4(horizon_corner(-1.0), FULLSCREEN_DEPTH, 1.0);
}

// @part polar_grid
// A grid round the eye's foot, even in heading and in depression angle, so vertices spread evenly over the picture.
// Covers the cone that holds the view; rows run from the nearest to the farthest visible water.
in vec2 a_grid;
out vec3 v_position;

uniform mat4 u_view_projection;
uniform float u_surface_top;
uniform float u_surface_trough; // no water is lower, m

const float FARTHEST = 1e5;

void main() {
    float cone = atan(length(vec2(length(u_ray_x), length(u_ray_y))));
    float pitch = asin(clamp(u_ray_z.y, -1.0, 1.0));
    float level = cos(pitch);
    bool all_round = abs(pitch) + cone > 1.55;
    float half_span = all_round ? PI : asin(min(sin(cone) / max(level, 1e-3), 1.0)) + 0.02;
    float heading = level > 1e-4 ? atan(u_ray_z.z, u_ray_z.x) : 0.0;
    float azimuth = heading + (2.0 * a_grid.x - 1.0) * half_span;

    // Crests stand nearer than troughs under the same angle: the nearest row counts from the top, the farthest from the troughs.
    float steepest = min(cone - pitch + 0.02, 0.5 * PI);
    float flattest = -pitch - cone - 0.02;
    float above_top = max(u_eye_height - u_surface_top, 0.0);
    float nearest = steepest > 0.0 ? above_top * max(cos(steepest), 0.0) / sin(steepest) : FARTHEST;
    float farthest = flattest > 1e-4 ? abs(u_eye_height - u_surface_trough) * cos(flattest) / sin(flattest) : FARTHEST;
    float height = max(abs(u_eye_height - 0.5 * (u_surface_top + u_surface_trough)), 0.05);
    float first = atan(height, min(nearest, FARTHEST));
    float last = atan(height, min(max(farthest, nearest), FARTHEST));
    float depression = mix(first, last, a_grid.y);
    float radius = height * cos(depression) / sin(depression);

    vec2 p = radius * vec2(cos(azimuth), sin(azimuth));
    vec3 ray = vec3(p.x, -u_eye_height, p.y);
    ray /= max(dot(ray, u_ray_z), 0.1 * length(ray));
    v_position = vec3(p.x, waves_shading(p, footprint(ray, length(p) / max(length(ray.xz), 1e-6), vec3(0.0, 1.0, 0.0))).x, p.y);
    gl_Position = u_view_projection * vec4(v_position, 1.0);
}
