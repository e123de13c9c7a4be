// The sun's irradiance on a surface that faces it.
uniform vec3 u_sun_irradiance;
