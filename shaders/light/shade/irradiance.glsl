// Irradiance of sun and sky. docs/formulae.md, section 6.
uniform vec3 u_sun_irradiance; // on a surface that faces the sun
uniform vec3 u_sky_irradiance; // on level water

// On a surface with normal n, a unit vector; `sun`: the share of the sun that reaches it.
vec3 irradiance_past(vec3 n, float sun) {
    return u_sun_irradiance * (sun * max(dot(n, u_sun_direction), 0.0)) + u_sky_irradiance * (0.5 + 0.5 * n.y);
}
