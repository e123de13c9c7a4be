// No land.
float land_met(vec3 o, vec3 d, out vec3 light) {
    light = vec3(0.0);
    return -1.0;
}
