// Sunlight that comes through a thin crest toward the eye; height in metres.
uniform float u_translucency;
uniform float u_crest_trough; // no water is lower, m
uniform float u_crest_height; // 1 / greatest height over that, 1/m

vec3 crest_light(vec3 d, vec3 absorption, float height) {
    float crest = (height - u_crest_trough) * u_crest_height;
    float toward_sun = max(dot(d.xz, u_sun_direction.xz), 0.0);
    return u_translucency / PI * u_sun_irradiance * exp(-6.0 * absorption) * (crest * crest * toward_sun);
}
