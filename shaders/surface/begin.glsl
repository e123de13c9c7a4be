// Where a march along a ray from the eye may begin. docs/formulae.md, section 3.
// tau before which no ray of a tile of the picture meets: r the water's surface, g land over y = 0; of the surface's slope (b) and
// second derivative (a, 1/m) the greatest.
uniform sampler2D u_start;

// Begins at 0 outside the picture. ray: not normalised, 1 along the view.
vec4 march_start(vec3 ray) {
    vec2 clip = vec2(dot(ray, u_ray_x) / dot(u_ray_x, u_ray_x), dot(ray, u_ray_y) / dot(u_ray_y, u_ray_y));
    ivec2 size = textureSize(u_start, 0);
    vec4 start = texelFetch(u_start, clamp(ivec2((0.5 * clip + 0.5) * vec2(size)), ivec2(0), size - 1), 0);
    return any(greaterThan(abs(clip), vec2(1.0))) ? vec4(0.0, 0.0, start.ba) : start;
}
