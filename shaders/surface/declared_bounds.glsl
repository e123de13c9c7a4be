// Bounds that the scene alone states: height over y = 0 (m), slope, second derivative (1/m).
uniform vec3 u_surface_bounds;

vec3 declared_bounds(vec3 ray, float aside, float from) {
    return u_surface_bounds;
}
