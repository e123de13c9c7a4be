// Normal of land and floor, up. p: m from the eye.
vec3 floor_normal(vec2 p) {
    vec4 ground = shore_floor(shore_place(p));
    return normalize(vec3(-ground.y, 1.0, -ground.z));
}
