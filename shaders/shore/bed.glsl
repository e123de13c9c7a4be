// The shore's floor, lit through the water by sun and sky, `down` metres under the surface. docs/formulae.md, section 11.
uniform float u_bed_sun; // cosine of the sun's ray in the water to the vertical

vec3 bed_light(vec2 at, float down, Footprint fp) {
    vec2 q = shore_place(at);
    vec3 extinction = 1.0 / u_absorption_length + u_scattering;
    vec3 sun = u_sun_irradiance * max(u_sun_direction.y, 0.0) * exp(-extinction * (down / u_bed_sun));
    vec3 sky = u_sky_irradiance * exp(-extinction * down);
    return 0.95 / PI * ground_albedo(shore_floor(q), shore_grain(q, fp)) * (sun + sky);
}
