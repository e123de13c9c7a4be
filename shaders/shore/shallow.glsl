// The floor under shallow water is the land in detail, soaked, or the water's edge would show as a seam; deeper it is the plain ground.
vec3 floor_albedo(vec2 at, vec4 ground, Footprint fp) {
    vec3 plain = ground_albedo(ground, shore_grain(at, fp));
    float deep = smoothstep(0.1, 0.6, -ground.x);
    // Seen as if it lay far lower: plants of the land do not grow there.
    vec4 sunk = vec4(ground.x - 8.0 * smoothstep(0.0, 0.15, -ground.x), ground.yzw);
    return deep < 1.0 ? mix(land_soil(at, sunk, fp, vec2(1.0)).albedo, plain, deep) : plain;
}
