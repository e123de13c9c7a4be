// Where a march along a ray from the eye may begin. docs/formulae.md, section 3.
// tau before which no ray of a tile of the picture meets: r + g the water's surface, b land over y = 0; a: second derivative of the
// surface at most (1/m), from 60000 on unknown.
uniform sampler2D u_start;
uniform float u_surface_trough; // no water is lower, m
uniform float u_surface_grain;  // what maps may add to the surface between their texels, m

// Of water, of land, and the second derivative. Outside the picture begins at 0 and nothing is known.
// ray: not normalised, 1 along the view.
vec3 march_start(vec3 ray) {
    vec2 clip = vec2(dot(ray, u_ray_x) / dot(u_ray_x, u_ray_x), dot(ray, u_ray_y) / dot(u_ray_y, u_ray_y));
    ivec2 size = textureSize(u_start, 0);
    vec4 start = texel_at(u_start, clamp(ivec2((0.5 * clip + 0.5) * vec2(size)), ivec2(0), size - 1));
    float curvature = start.a < 60000.0 ? start.a : 1e9;
    return any(greaterThan(abs(clip), vec2(1.0))) ? vec3(0.0, 0.0, 1e9) : vec3(start.r + start.g, start.b, curvature);
}

// Gap over tau from which on Newton's method finishes a march: a share of a sample's height.
float march_tolerance() {
    return MARCH_TOLERANCE * length(u_ray_y) * 2.0 / u_viewport.y;
}
