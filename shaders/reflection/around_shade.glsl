// Light on land and air before it, for the pass that draws the cube map: as in light/shade/lit.glsl, without the water.
uniform vec3 u_sky_irradiance;
uniform float u_visibility; // m

vec3 irradiance(vec3 n) {
    return u_sun_irradiance * max(dot(n, u_sun_direction), 0.0) + u_sky_irradiance * (0.5 + 0.5 * n.y);
}

vec3 in_air(vec3 light, vec3 d, float distance_to_eye) {
    return mix(exposure() * horizon_light(d), light, exp(-3.912 / u_visibility * distance_to_eye));
}
