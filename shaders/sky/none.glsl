// No light: a black sky.
vec3 sky_light(vec3 d) {
    return vec3(0.0);
}

vec3 horizon_light(vec3 d) {
    return vec3(0.0);
}

// As water mirrors it. r: reflected direction, over the horizon.
vec3 mirrored_sky(vec3 r) {
    return vec3(0.0);
}

float exposure() {
    return 1.0;
}
