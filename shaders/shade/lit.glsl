// Water, foam and air under sun and sky. docs/formulae.md, section 6. d, n: unit vectors; roughness2: lost mean square slope.
uniform float u_roughness;           // root mean square slope
uniform float u_visibility;          // m

vec3 irradiance(vec3 n) {
    return u_sun_irradiance * max(dot(n, u_sun_direction), 0.0) + u_sky_irradiance * (0.5 + 0.5 * n.y);
}

vec3 water_light(vec3 place, vec3 d, vec3 n, float lost, float height) {
    float sigma2 = u_roughness * u_roughness + lost;
    float nv = max(-dot(n, d), 0.0);
    float cv = sqrt(nv * nv + sigma2 * (1.0 - nv * nv));
    float reflectance = fresnel(min(cv, 1.0));

    vec3 r = reflect(d, n);
    r.y = sqrt(max(r.y, 0.0) * max(r.y, 0.0) + sigma2);
    vec3 reflected = reflected_light(place, normalize(r));

    vec3 below = 0.95 * irradiance(n) / PI;
    vec3 absorption = 1.0 / u_absorption_length;
    vec3 deep = 0.4 * u_scattering / (absorption + u_scattering) * below;
    vec3 body = water_body(below, deep, absorption + u_scattering, cv, height);
    body += crest_light(d, absorption, height);
    return (1.0 - reflectance) * body + reflectance * reflected + glitter_light(d, n, sigma2, cv);
}

vec3 foam_light(vec3 n) {
    return foam_albedo() / PI * irradiance(n);
}

vec3 in_air(vec3 light, vec3 d, float distance_to_eye) {
    return mix(exposure() * horizon_light(d), light, exp(-3.912 / u_visibility * distance_to_eye));
}
