// Water, foam and air under sun and sky. docs/formulae.md, section 6. d, n: unit vectors; lost: mean square slope that the footprint
// took out, of waves (x) and of ripples (y); f: saturation of the foam over the water.
uniform float u_roughness; // root mean square slope

// How much of the sun the foam beside leaves to the water and to the foam of a place (foam/relief.glsl).
vec2 sun_past_foam = vec2(1.0);

vec3 water_light(vec3 place, vec3 d, vec3 n, vec2 lost, float height, float f) {
    float base2 = u_roughness * u_roughness;
    float lost2 = lost.x + lost.y;
    float sigma2 = base2 + lost2;
    float nv = max(-dot(n, d), 0.0);
    float aside2 = max(1.0 - nv * nv, 1e-8);
    float cv = sqrt(nv * nv + sigma2 * aside2);

    // Two facets stand for what was lost, tilted to the eye and from it. Those of waves count by what the eye sees of them.
    float lean = sqrt(0.5 * lost2 * aside2);
    vec2 c = clamp(nv + vec2(lean, -lean), 0.0, 1.0);
    float more = 0.5 * lost.x * (c.x - c.y) / (max(lost2, 1e-9) * (c.x + c.y + 1e-6));
    vec2 raised = sqrt(c * c + base2 * (1.0 - c * c));
    float to_eye = (0.5 + more) * fresnel(raised.x);
    float from_eye = (0.5 - more) * fresnel(raised.y);
    float reflectance = to_eye + from_eye;

    // Mirrored by their mean, as they reflect.
    vec3 facet = n - lean * (to_eye - from_eye) / (reflectance * aside2) * (d + nv * n);
    vec3 r = d - 2.0 * dot(d, facet) / dot(facet, facet) * facet;
    r.y = sqrt(max(r.y, 0.0) * max(r.y, 0.0) + base2 + 0.5 * lost2);
    vec3 reflected = reflected_light(place, normalize(r));

    vec3 below = 0.95 * irradiance_past(n, sun_past_foam.x) / PI;
    vec3 absorption = 1.0 / u_absorption_length;
    vec3 extinction = absorption + u_scattering;
    vec3 deep = 0.4 * u_scattering / extinction * below;
    vec3 body = water_body(below, deep, extinction, cv, height);
    body = aerated(body, deep, below, extinction, cv, f);
    body += crest_light(d, absorption, height);
    return (1.0 - reflectance) * body + reflectance * reflected + glitter_light(d, n, sigma2, cv);
}

vec3 foam_light(vec3 n) {
    return foam_albedo() / PI * irradiance_past(n, sun_past_foam.y);
}
