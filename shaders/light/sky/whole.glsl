// Air, moonlight and clouds together.
const float SKY_EYE = 1e-3;     // detail of clouds that an eye tells apart, rad
const float SKY_MIRROR = 0.012; // and that water mirrors, whose ripples blur the rest

vec3 clear_sky(vec3 d) {
    return sun_glow(d) + moon_glow(d);
}

vec3 sky_seen(vec3 d, float blur) {
    float hidden;
    vec4 layer = clouds(d, blur, hidden);
    return clear_sky(d) * (1.0 - layer.a) + layer.rgb;
}

vec3 sky_light(vec3 d) {
    return sky_seen(d, SKY_EYE);
}

// Toward the horizon under or over d, where the air hides all clouds; straight up and down are of no heading.
vec3 horizon_light(vec3 d) {
    vec2 level = d.xz / max(length(d.xz), 1e-6);
    return clear_sky(vec3(level.x, 0.0, level.y));
}

// As water mirrors it: its clouds blurred. r: reflected direction, over the horizon.
vec3 mirrored_sky(vec3 r) {
    return sky_seen(r, SKY_MIRROR);
}
