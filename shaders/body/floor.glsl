// Water over a floor: light goes down and comes back along the refracted ray, absorbed and scattered out on the way.
vec3 water_body(vec3 below, vec3 deep, vec3 extinction, float cv, float height) {
    float ct = sqrt(1.0 - (1.0 - min(cv * cv, 1.0)) / (1.34 * 1.34));
    vec3 passed = exp(-extinction * (max(u_floor_depth + height, 0.0) * (1.0 + 1.0 / ct)));
    return mix(deep, u_floor_albedo * below, passed);
}
