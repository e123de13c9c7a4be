// The land that a ray meets from o along d (unit), m away, and its light; negative: none.
float land_met(vec3 o, vec3 d, out vec3 light) {
    vec2 q = shore_place(o.xz);
    float t;
    vec4 ground;
    light = vec3(0.0);
    if (!land_along(q, o.y, d, t, ground)) {
        return -1.0;
    }
    light = land_seen(q, d, t, ground);
    return t;
}
