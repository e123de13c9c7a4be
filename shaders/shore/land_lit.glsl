// Land under sun and sky; where it is wet, the sky mirrors in its film of water. d, level: unit vectors, level: normal of the film;
// sun: the share of the sun that reaches it.
vec3 land_light(vec3 d, vec3 level, Soil soil, float sun) {
    float nv = max(-dot(level, d), 0.0);
    float mirror = soil.film * fresnel(sqrt(nv * nv + FILM_ROUGHNESS * (1.0 - nv * nv)));
    vec3 r = reflect(d, level);
    r.y = sqrt(max(r.y, 0.0) * max(r.y, 0.0) + FILM_ROUGHNESS);
    return (1.0 - mirror) * soil.albedo / PI * irradiance_past(soil.normal, sun) + mirror * sky_light(normalize(r));
}
