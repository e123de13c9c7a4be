// Exposed light of air and clouds toward d, and how much they hide of what is beyond (A).
vec4 exposed_air(vec3 d) {
    float hidden;
    vec3 air = behind_clouds(clear_sky(d), d, SKY_EYE, hidden);
    return vec4(exposure() * air, hidden);
}
