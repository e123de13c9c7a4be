// The sky once the sun is so deep under the horizon that it lights none of it. docs/formulae.md, section 9.
const vec3 SKY_NIGHT = vec3(0.002, 0.0034, 0.0075);

vec3 sun_glow(vec3 d) {
    return SKY_NIGHT;
}

vec3 sun_glow_rim(vec2 level, vec3 d) {
    return SKY_NIGHT;
}
