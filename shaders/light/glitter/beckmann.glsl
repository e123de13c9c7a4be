// The sun mirrored by facets whose slopes are Gaussian (Beckmann 1963). d, n: unit vectors; sigma2: mean square slope.
vec3 glitter_light(vec3 d, vec3 n, float sigma2, float cv) {
    vec3 between = u_sun_direction - d;
    vec3 h = between / max(length(between), 1e-6);
    float nh = max(dot(n, h), 1e-3);
    float nh2 = nh * nh;
    float slopes = exp(-max(1.0 - nh2, 0.0) / (nh2 * sigma2)) / (PI * sigma2 * nh2 * nh2);
    return min(u_sun_irradiance * (fresnel(max(dot(u_sun_direction, h), 0.0)) * slopes / (4.0 * cv)), 1e4);
}
