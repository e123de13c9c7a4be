// Open water: nothing stands before it.
bool find_land_before(vec3 ray, bool wet, float tau, out float land_tau, out vec4 ground) {
    land_tau = 0.0;
    ground = vec4(0.0);
    return false;
}

vec4 land_color(vec3 ray, vec3 d, float tau, vec4 ground) {
    return vec4(0.0);
}
