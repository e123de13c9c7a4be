// The water between an eye under the surface and what it sees: it absorbs and glows. docs/formulae.md, section 11.

vec3 below_extinction() {
    return 1.0 / u_absorption_length + u_scattering;
}

// Light that the water itself sends along a way of `reach` metres that starts `depth` metres down, seen from its start; `fall`:
// how fast the way goes down. Light and sight fade alike: 1 + fall is 0 straight up, where it is held.
vec3 below_glow(float depth, float fall, float reach) {
    vec3 extinction = below_extinction();
    vec3 lit = 0.95 / PI * (u_sun_irradiance * max(u_sun_direction.y, 0.0) + u_sky_irradiance);
    vec3 deep = 0.4 * u_scattering / extinction * lit;
    float both = max(1.0 + fall, 1e-3);
    return 2.0 * deep * exp(-extinction * max(depth, 0.0)) * (1.0 - exp(-extinction * (both * reach))) / both;
}
