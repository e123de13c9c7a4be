// Defined below, where water is shaded.
vec3 irradiance(vec3 n);
vec3 in_air(vec3 light, vec3 d, float distance_to_eye);
