// Sky radiance toward d: single scattering in closed form with a flat share for the rest. docs/formulae.md, section 6.
// Any direction; below the horizon the horizon's own colour. Unit: that of the sun's irradiance.
uniform vec3 u_sun_direction;
uniform vec3 u_air_light;      // irradiance of the light in the air
uniform vec3 u_rayleigh_depth; // optical depth at the zenith
uniform float u_mie_depth;

vec3 sky_light(vec3 d) {
    float gamma = dot(d, u_sun_direction);
    vec3 depth = u_rayleigh_depth + u_mie_depth;
    float mass = 1.0 / (max(d.y, 0.0) + 0.09);
    float rayleigh = 0.0596831036594608 * (1.0 + gamma * gamma);
    // 1 + G^2 - 2 G gamma is at least (1 - G)^2, so the power stays finite
    float apart = max(1.5776 - 1.52 * gamma, 0.0576);
    float mie = 0.0336144922 / (apart * sqrt(apart));
    vec3 scattered = (u_rayleigh_depth * rayleigh + u_mie_depth * mie) / depth + 0.04;
    return u_air_light * scattered * (1.0 - exp(-depth * mass));
}

// As water mirrors it. r: reflected direction, over the horizon.
vec3 mirrored_sky(vec3 r) {
    return sky_light(r);
}
