// The lake's highlight (lake water shader, 2008): Blinn-Phong about a half vector that is pushed aside by the normal's own
// tilt, with the source's colour and strength; its white stands for white paper in the sun. d, n: unit vectors.
uniform float u_specular_power;
uniform float u_specular_perturb;

vec3 glitter_light(vec3 d, vec3 n, float sigma2, float cv) {
    vec3 h = u_sun_direction - d + u_specular_perturb * vec3(n.x, 0.0, n.z);
    float nh = clamp(dot(n, h) / max(length(h), 1e-6), 0.0, 1.0);
    return u_sun_irradiance / PI * (0.6 * pow(nh, u_specular_power)) * vec3(0.98, 0.97, 0.7);
}
