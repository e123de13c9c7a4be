// Light at the water's surface and in it.

// @part optics
// What water takes from light.
uniform vec3 u_absorption_length; // m
uniform float u_scattering;       // 1/m

// @part irradiance
// Irradiance of sun and sky. docs/formulae.md, section 6.
uniform vec3 u_sun_irradiance; // on a surface that faces the sun
uniform vec3 u_sky_irradiance; // on level water

// On a surface with normal n, a unit vector; `sun`: the share of the sun that reaches it.
vec3 irradiance_past(vec3 n, float sun) {
    return u_sun_irradiance * (sun * max(dot(n, u_sun_direction), 0.0)) + u_sky_irradiance * (0.5 + 0.5 * n.y);
}

// @part haze
// Haze: exponential extinction to the light of the horizon (Koschmieder 1924). docs/formulae.md, section 6.
// light: of what stands so far away, m; horizon: of the horizon behind it.
vec3 hazed(vec3 light, vec3 horizon, float distance_to_eye) {
    return mix(horizon, light, air_passed(distance_to_eye));
}

// Of exposed light from direction d.
vec3 in_air(vec3 light, vec3 d, float distance_to_eye) {
    return hazed(light, exposure() * horizon_light(d), distance_to_eye);
}

// @part flat
// No light: water is black, foam white, as the paper's equations have them.
vec3 water_light(vec3 place, vec3 d, vec3 n, vec2 unresolved, float height, float f) {
    return vec3(0.0);
}

float shade_sun(vec3 place, Footprint fp) {
    return 1.0;
}

vec3 foam_light(vec3 n) {
    return vec3(1.0);
}

vec3 in_air(vec3 light, vec3 d, float distance_to_eye) {
    return light;
}

// @part lit
// Water, foam and air under sun and sky. docs/formulae.md, section 6. d, n: unit vectors; unresolved: mean square slope that the
// footprint does not resolve, of waves (x) and of ripples (y); f: saturation of the foam over the water.
uniform float u_roughness; // root mean square slope
uniform vec2 u_slope_heading; // (a - b)/(a + b) of the slope variances a along the sea's wind and b across it, toward twice its heading

// How much of the sun the foam beside leaves to the water and to the foam of a place (foam/relief.glsl).
vec2 sun_past_foam = vec2(1.0);
// How much of the sun reaches the place past all else, also a factor of the former.
float sun_reaches = 1.0;

// Called before water, foam or land is lit at a place.
float shade_sun(vec3 place, Footprint fp) {
    sun_reaches = sunlit(place, fp);
    sun_past_foam *= sun_reaches;
    return sun_reaches;
}

vec3 water_light(vec3 place, vec3 d, vec3 n, vec2 unresolved, float height, float f) {
    float base2 = u_roughness * u_roughness;
    float unresolved2 = unresolved.x + unresolved.y;
    float sigma2 = base2 + unresolved2;
    float nv = max(-dot(n, d), 0.0);
    float aside2 = max(1.0 - nv * nv, 1e-8);
    float cv = sqrt(nv * nv + sigma2 * aside2);

    // Two facets stand for the unresolved slopes, as far to the eye and from it as those that it sees deviate about their mean. Facets of
    // waves count by what shows of them, a normal law times the cosine; those of ripples, which only tilt the normal, count alike.
    vec2 level = vec2(d.x * d.x - d.z * d.z, 2.0 * d.x * d.z) / max(dot(d.xz, d.xz), 1e-8);
    float deviation = sqrt(0.5 * unresolved2 * (1.0 + dot(level, u_slope_heading)) * aside2);
    float x = min(nv / max(deviation, 1e-5), 20.0);
    float front = 1.0 / (1.0 + exp(-1.5976 * x - 0.07056 * x * x * x));
    float rim = 0.39894 * exp(-0.5 * x * x);
    vec2 moment = vec2((x * x + 1.0) * front + x * rim, (x * x + 3.0) * x * front + (x * x + 2.0) * rim) / (rim + x * front);
    float of_waves = unresolved.x / max(unresolved2, 1e-9);
    float middle = nv + of_waves * deviation * (moment.x - x);
    float lean = deviation * sqrt(mix(1.0, max(moment.y - moment.x * moment.x, 0.0), of_waves));
    vec2 c = clamp(middle + vec2(lean, -lean), 0.0, 1.0);
    vec2 raised = sqrt(c * c + base2 * (1.0 - c * c));
    vec2 share = 0.5 * vec2(fresnel(raised.x), fresnel(raised.y));
    float reflectance = share.x + share.y;
    share /= reflectance;

    // Mirrored by their mean, as they reflect.
    vec3 facet = n - (dot(share, c) - nv) / aside2 * (d + nv * n);
    vec3 r = d - 2.0 * dot(d, facet) / dot(facet, facet) * facet;
    // Slopes about that mean turn the mirrored ray by twice as much in the plane of incidence, and across it by as much less as the look
    // is flatter. What they turn under the horizon comes from there.
    float within = share.x * share.y * (c.x - c.y) * (c.x - c.y) / aside2;
    float turned = 2.0 * sqrt(within);
    float over = clamp(r.y / max(turned, 1e-5), -4.0, 4.0);
    float risen = r.y + turned * (0.39894 * exp(-0.5 * over * over) + over / (1.0 + exp(-1.5976 * over - 0.07056 * over * over * over)) - over);
    r.y = sqrt(max(risen, 0.0) * max(risen, 0.0) + base2 + 0.15 * unresolved2);
    vec3 spread = vec3(sqrt(2.0 * vec2(base2 + 2.0 * within, cv * cv * sigma2)), turned);
    vec3 reflected = reflected_light(place, normalize(r), spread);

    vec3 below = 0.95 * irradiance_past(n, sun_past_foam.x) / PI;
    vec3 absorption = 1.0 / u_absorption_length;
    vec3 extinction = absorption + u_scattering;
    vec3 deep = 0.4 * u_scattering / extinction * below;
    vec3 body = water_body(below, deep, extinction, cv, height);
    body = aerated(body, deep, below, extinction, cv, f);
    body += sun_reaches * crest_light(d, absorption, height);
    return (1.0 - reflectance) * body + reflectance * reflected + sun_reaches * glitter_light(d, n, sigma2, cv);
}

vec3 foam_light(vec3 n) {
    return foam_albedo() / PI * irradiance_past(n, sun_past_foam.y);
}

// @part translucent
// Sunlight that comes through a thin crest toward the eye; height in metres.
uniform float u_translucency;
uniform float u_crest_trough; // no water is lower, m
uniform float u_crest_height; // 1 / greatest height over that, 1/m

vec3 crest_light(vec3 d, vec3 absorption, float height) {
    float crest = (height - u_crest_trough) * u_crest_height;
    float toward_sun = max(dot(d.xz, u_sun_direction.xz), 0.0);
    return u_translucency / PI * u_sun_irradiance * exp(-6.0 * absorption) * (crest * crest * toward_sun);
}
