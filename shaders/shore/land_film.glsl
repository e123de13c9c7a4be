// Land under sun and sky; where it is wet, sky and sun mirror in its film of water. d, level: unit vectors, level: normal of the film;
// sun: the share of the sun that reaches it.
vec3 land_light(vec3 d, vec3 level, Soil soil, float sun) {
    float nv = max(-dot(level, d), 0.0);
    float cv = sqrt(nv * nv + FILM_ROUGHNESS * (1.0 - nv * nv));
    float mirror = soil.film * fresnel(cv);
    vec3 r = reflect(d, level);
    r.y = sqrt(max(r.y, 0.0) * max(r.y, 0.0) + FILM_ROUGHNESS);
    vec3 light = (1.0 - mirror) * soil.albedo / PI * irradiance_past(soil.normal, sun);
    if (mirror <= 0.0) {
        return light;
    }
    // Facets as those of the water (light/glitter/beckmann.glsl).
    vec3 between = u_sun_direction - d;
    vec3 h = between / max(length(between), 1e-6);
    float nh = max(dot(level, h), 1e-3);
    float nh2 = nh * nh;
    float slopes = exp(-max(1.0 - nh2, 0.0) / (nh2 * FILM_ROUGHNESS)) / (PI * FILM_ROUGHNESS * nh2 * nh2);
    vec3 glint = min(u_sun_irradiance * (fresnel(max(dot(u_sun_direction, h), 0.0)) * slopes / (4.0 * cv)), 1e4);
    return light + mirror * sky_light(normalize(r)) + soil.film * sun * glint;
}
