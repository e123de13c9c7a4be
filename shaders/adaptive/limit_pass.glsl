// The least of four limits at which the samples stay within the budget, and between which two of them the next four lie.
uniform sampler2D u_counts;
uniform vec2 u_picture; // pixels
uniform float u_eye_height;
uniform float u_surface_top;
uniform vec3 u_ray_x;
uniform vec3 u_ray_y;
uniform vec3 u_ray_z;
out vec4 o_limit;

void main() {
    ivec2 parts = textureSize(u_counts, 0);
    vec4 fours = vec4(0.0);
    // Sky costs next to nothing: the budget is for what is under the horizon.
    float under = 0.0;
    bool low = u_eye_height < u_surface_top;
    for (int y = 0; y < parts.y; ++y) {
        vec4 row = vec4(0.0);
        for (int x = 0; x < parts.x; ++x) {
            row += texelFetch(u_counts, ivec2(x, y), 0);
            vec2 clip = 2.0 * (vec2(x, y) + 0.5) / vec2(parts) - 1.0;
            under += low || u_ray_z.y + clip.x * u_ray_x.y + clip.y * u_ray_y.y < 0.0 ? 1.0 : 0.0;
        }
        fours += row;
    }
    vec2 tried = limits();
    float budget = 0.25 * CHOOSE_BUDGET * u_picture.x * u_picture.y * under / float(parts.x * parts.y);
    float closer = sqrt(sqrt(tried.y));
    vec2 next = vec2(tried.x * tried.y * tried.y * tried.y * closer, closer);
    vec4 at = tried.x * vec4(1.0, tried.y, tried.y * tried.y, tried.y * tried.y * tried.y);
    float limit = 1e9;
    for (int k = 3; k >= 0; --k) {
        if (fours[k] <= budget) {
            limit = at[k];
            // Under the very least none is tried.
            next = LIMITS_FIRST && k == 0 ? vec2(limit, 1.0) : vec2(limit / (closer * closer * closer), closer);
        }
    }
    o_limit = vec4(next, limit, 1.0);
}
