// The sun is down: no disc.
vec3 sun_disc(vec3 d) {
    return vec3(0.0);
}
