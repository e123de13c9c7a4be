// Water over a floor: light goes down and comes back along the refracted ray, absorbed and scattered out on the way.
vec3 water_body(vec3 below, vec3 deep, vec3 extinction, float cv, float height) {
    float slant = refracted_cosine(min(cv, 1.0), INDEX);
    vec3 passed = exp(-extinction * (max(u_floor_depth + height, 0.0) * (1.0 + 1.0 / slant)));
    return mix(deep, u_floor_albedo * below, passed);
}
