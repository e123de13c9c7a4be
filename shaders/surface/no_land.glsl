// Open water: nothing stands before it.
bool find_land_before(vec3 ray, vec3 d, bool wet, float tau, out vec4 color) {
    color = vec4(0.0);
    return false;
}
