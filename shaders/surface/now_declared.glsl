// What the scene alone states of the surface.
uniform float u_surface_steepest;

// Height of the highest crest, m: what the scene states is in u_surface_top.
float surface_top_now() {
    return 1e30;
}

// Slope at most; how high the short waves stand at most (m), and their second derivative (1/m), where they are told apart.
vec3 surface_now() {
    return vec3(u_surface_steepest, 0.0, 0.0);
}
