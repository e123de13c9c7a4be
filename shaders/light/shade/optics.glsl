// What light meets in water: the sky's irradiance on it, and what it takes away.
uniform vec3 u_sky_irradiance;
uniform vec3 u_absorption_length; // m
uniform float u_scattering;       // 1/m
