// What all lamps of a layered sky share. docs/formulae.md, section 9.
uniform vec3 u_sun_direction;    // toward the lamp: the sun, or the moon once the sun is well down
uniform vec3 u_rayleigh_depth;   // optical depth at the zenith
uniform float u_mie_depth;
uniform float u_haze_depth;      // along the horizon
uniform float u_visibility;      // where 2 % of the contrast is left, m

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

// Share of light that passes through so much air, m: molecules take more of the blue, and haze the rest that the visibility leaves.
vec3 air_passed(float way) {
    const vec3 MOLECULES = vec3(6.54e-6, 1.405e-5, 3.16e-5);
    vec3 extinction = max(3.912 / u_visibility - MOLECULES.g, 0.0) * vec3(0.826, 1.0, 1.225) + MOLECULES;
    return exp(-extinction * way);
}
