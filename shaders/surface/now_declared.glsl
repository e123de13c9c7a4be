// What the scene alone states of the surface.
uniform float u_surface_steepest;

// Slope at most; how high the short waves stand at most (m), and their second derivative (1/m), where they are told apart.
vec3 surface_now() {
    return vec3(u_surface_steepest, 0.0, 0.0);
}
