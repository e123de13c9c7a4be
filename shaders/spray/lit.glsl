// Light of a drop toward the eye, with the air before it. d: from the eye, a unit vector; sun: the share of the sun
// that reaches it. Held: a screen is white long before.
const float SPRAY_BRIGHTEST = 64.0;

// Sun and sky scattered all round. face: where the water beside it ends.
vec3 spray_scattered(vec3 face, vec3 d, float sun, float distance_to_eye) {
    vec3 light = (u_sun_irradiance * (sun * (0.5 + 0.4 * dot(face, u_sun_direction))) + 0.9 * u_sky_irradiance) / PI;
    return min(exposure() * hazed(light, horizon_light(d), distance_to_eye), SPRAY_BRIGHTEST);
}

// The sun's light that drops send on nearly as it came, where they are few: 0.8 of it onward in the mean (Henyey and Greenstein 1941).
vec3 spray_onward(vec3 d, float sun, float distance_to_eye) {
    float x = 1.64 - 1.6 * dot(d, u_sun_direction);
    vec3 light = u_sun_irradiance * (0.36 * sun / (2.0 * PI * x * sqrt(x)));
    return min(exposure() * light * exp(-3.912 / u_visibility * distance_to_eye), SPRAY_BRIGHTEST);
}
