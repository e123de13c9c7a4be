// What water takes from light.
uniform vec3 u_absorption_length; // m
uniform float u_scattering;       // 1/m
