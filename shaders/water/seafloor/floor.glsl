// A floor, lit through the water by sun and sky. docs/formulae.md, section 11.
uniform float u_bed_sun; // cosine of the sun's ray in the water to the vertical

// Radiance of the floor at a place (m from the eye), `down` metres under the surface.
vec3 bed_light(vec2 at, float down, Footprint fp) {
    vec3 extinction = 1.0 / u_absorption_length + u_scattering;
    // Where the sun's ray enters level water.
    vec2 enters = at + down / (INDEX * u_bed_sun) * u_sun_direction.xz;
    vec3 sun = u_sun_irradiance * (sunlit(vec3(enters.x, 0.0, enters.y), fp) * max(u_sun_direction.y, 0.0))
        * bed_sunlight(at, fp) * exp(-extinction * (down / u_bed_sun));
    vec3 sky = u_sky_irradiance * exp(-extinction * down);
    return 0.95 / PI * bed_albedo(at, fp) * (sun + sky);
}
