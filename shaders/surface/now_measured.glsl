// What the frame has measured of the surface.
uniform sampler2D u_surface_now;

// Height of the highest crest, m.
float surface_top_now() {
    return texel_at(u_surface_now, ivec2(0)).a;
}

// Slope at most; how high the short waves stand at most (m), and their second derivative (1/m), where they are told apart.
vec3 surface_now() {
    return texel_at(u_surface_now, ivec2(0)).xyz;
}
