// Sky radiance toward d: single scattering in closed form with a flat share for the rest. docs/formulae.md, section 6.
// Any direction; below the horizon the horizon's own colour. Unit: that of the sun's irradiance.
uniform vec3 u_sun_direction;
uniform vec3 u_air_rayleigh; // radiance of the whole air, square to the sun
uniform vec3 u_air_mie;      // and of its haze, over its phase function's power
uniform vec3 u_air_even;     // and of what was scattered more than once
uniform vec3 u_air_depth;    // optical depth at the zenith
uniform vec3 u_air_horizon;  // share of the whole air's light that the horizon has
uniform float u_visibility;  // where 2 % of the contrast is left, m

// Share of light that passes through so much air, m.
float air_passed(float way) {
    return exp(-3.912 / u_visibility * way);
}

// gamma: cosine of the angle from the sun.
vec3 air_scattered(float gamma) {
    // 1 + G^2 - 2 G gamma is at least (1 - G)^2, so the power stays finite
    float apart = max(1.5776 - 1.52 * gamma, 0.0576);
    return u_air_even + (1.0 + gamma * gamma) * u_air_rayleigh + u_air_mie / (apart * sqrt(apart));
}

vec3 sky_light(vec3 d) {
    return air_scattered(dot(d, u_sun_direction)) * (1.0 - exp(-u_air_depth / (max(d.y, 0.0) + 0.09)));
}

// Toward the horizon under or over d; straight up and down are of no heading.
vec3 horizon_light(vec3 d) {
    return air_scattered(dot(d.xz, u_sun_direction.xz) / max(length(d.xz), 1e-6)) * u_air_horizon;
}

// As water mirrors it, by two looks that stand for those of slopes that no sample resolves (spread.z: their deviation up and down, rad).
// r: the mean look, over the horizon.
vec3 mirrored_sky(vec3 r, vec3 spread) {
    float level = length(r.xz);
    vec3 aside = 0.8 * min(spread.z, r.y) * vec3(-r.y * r.xz / max(level, 1e-6), level).xzy;
    return 0.5 * (sky_light(normalize(r + aside)) + sky_light(normalize(r - aside)));
}
