// Light of a drop toward the eye: sun and sky scattered, mostly onward, and the air before it. d: from the eye, a unit vector.
vec3 spray_light(vec3 d, float distance_to_eye) {
    float onward = max(dot(d, u_sun_direction), 0.0);
    onward *= onward * onward;
    vec3 light = (u_sun_irradiance * (0.6 + 0.9 * onward * onward) + 0.8 * u_sky_irradiance) / PI;
    return exposure() * hazed(light, horizon_light(d), distance_to_eye);
}
