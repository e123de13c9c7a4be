// Haze: exponential extinction to the light of the horizon (Koschmieder 1924). docs/formulae.md, section 6.
// light: of what stands so far away, m; horizon: of the horizon behind it.
vec3 hazed(vec3 light, vec3 horizon, float distance_to_eye) {
    return mix(horizon, light, air_passed(distance_to_eye));
}

// Of exposed light from direction d.
vec3 in_air(vec3 light, vec3 d, float distance_to_eye) {
    return hazed(light, exposure() * horizon_light(d), distance_to_eye);
}
