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
