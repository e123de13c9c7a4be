// Land under sun and sky; where it is wet, the sky mirrors in its film of water. d, n: unit vectors.
vec3 land_light(vec3 d, vec3 n, vec3 albedo, float wet) {
    float nv = max(-dot(n, d), 0.0);
    float mirror = wet * 0.6 * fresnel(sqrt(nv * nv + 0.02 * (1.0 - nv * nv)));
    vec3 r = reflect(d, n);
    r.y = sqrt(max(r.y, 0.0) * max(r.y, 0.0) + 0.02);
    return (1.0 - mirror) * albedo / PI * irradiance(n) + mirror * sky_light(normalize(r));
}
