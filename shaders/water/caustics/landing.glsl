// Where the sun's light lands that enters the water at a corner of the grid. docs/formulae.md, section 11.
uniform sampler2D u_caustic_slopes;
uniform vec3 u_sun_direction;
uniform float u_caustic_index; // of refraction, of this colour
uniform float u_caustic_depth; // m
uniform vec2 u_caustic_flat;   // where light lands under level water, m
uniform float u_caustic_tile;  // m

// x, y: how far beside the place where light lands under level water, m; z: light over that on level water.
vec3 caustic_landing(ivec2 corner, int corners) {
    vec2 slope = texel_at(u_caustic_slopes, corner % corners).xy;
    vec3 n = normalize(vec3(-slope.x, 1.0, -slope.y));
    float c = max(dot(n, u_sun_direction), 0.0);
    vec3 ray = refracted(-u_sun_direction, n, c, u_caustic_index);
    // No ripple may tilt the ray level, and a sun on the horizon lights none by itself.
    vec2 way = ray.xz * (u_caustic_depth / max(-ray.y, 0.25));
    return vec3(way - u_caustic_flat, c / (n.y * max(u_sun_direction.y, 0.05)));
}
