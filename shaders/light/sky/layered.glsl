// A sky that light reaches through more air the lower one looks: single scattering in closed form with haze along the horizon and a flat
// share for the rest. docs/formulae.md, section 9. Any direction; below the horizon the horizon's own colour.
uniform vec3 u_sun_direction;    // toward the lamp: the sun, or the moon once the sun is well down
uniform vec3 u_rayleigh_depth;   // optical depth at the zenith
uniform float u_mie_depth;
uniform float u_haze_depth;      // along the horizon
uniform vec3 u_sky_sun;          // toward the sun
uniform vec3 u_sky_sun_path;     // optical depth of the air that its light passes down to here
uniform float u_sky_sun_power;   // irradiance over the air

const float SKY_NIGHT = 0.002;

// Optical depth of the air and the haze along a look.
vec3 air_depth(float y) {
    return (u_rayleigh_depth + u_mie_depth) / (y + 0.09) + u_haze_depth * 0.02 / (y + 0.02);
}

// Share that haze scatters by an angle with the cosine gamma (Henyey and Greenstein 1941, G = 0.76), over the sphere 1.
float mie_phase(float gamma) {
    // 1 + G^2 - 2 G gamma is at least (1 - G)^2, so the power stays finite
    float apart = max(1.5776 - 1.52 * gamma, 0.0576);
    return 0.0336144922 / (apart * sqrt(apart));
}

// Light of a lamp that the air scatters toward the eye. The higher one looks, the less air it came through.
vec3 air_glow(vec3 d, vec3 lamp, vec3 path, vec3 power, float least) {
    float y = max(d.y, 0.0);
    float gamma = dot(d, lamp);
    vec3 depth = air_depth(y);
    float rayleigh = 0.0596831036594608 * (1.0 + gamma * gamma);
    float mie = mie_phase(gamma);
    float grey = u_mie_depth / (y + 0.09) + u_haze_depth * 0.02 / (y + 0.02);
    vec3 once = (u_rayleigh_depth / (y + 0.09) * rayleigh + grey * mie) / depth;
    vec3 here = power * exp(-path * (0.08 + 0.7 * exp(-y / 0.12))) + least;
    vec3 above = power * exp(-0.08 * path) + least;
    return (here * once + above * 0.04) * (1.0 - exp(-depth));
}

vec3 sun_glow(vec3 d) {
    return air_glow(d, u_sky_sun, u_sky_sun_path, vec3(u_sky_sun_power), SKY_NIGHT);
}
