// Air, moonlight and clouds together.
const vec2 SKY_EYE = vec2(7e-4); // detail of clouds that an eye tells apart, rad

vec3 clear_sky(vec3 d) {
    return sun_glow(d) + moon_glow(d);
}

// The air's light toward d behind clouds; hidden: how much of what is behind all air.
vec3 behind_clouds(vec3 air, vec3 d, vec2 spread, out float hidden) {
    float thin;
    vec4 high = cirrus(d, spread, thin);
    vec4 layer = clouds(d, spread, hidden);
    hidden = 1.0 - (1.0 - thin) * (1.0 - hidden);
    vec3 light = (air * (1.0 - high.a) + high.rgb) * (1.0 - layer.a) + layer.rgb;
    return in_rain(light, d, spread, hidden);
}

vec3 sky_seen(vec3 d, vec2 spread) {
    float hidden;
    return behind_clouds(clear_sky(d), d, spread, hidden);
}

vec3 sky_light(vec3 d) {
    return sky_seen(d, SKY_EYE);
}

// Of the haze before the horizon under or over d, where clouds are one; straight up and down are of no heading. There is neither
// cirrus nor rain, and every program that has air would hold all clouds once more.
vec3 horizon_light(vec3 d) {
    vec2 level = d.xz / max(length(d.xz), 1e-6);
    vec4 layer = clouds_along_horizon();
    return (sun_glow_rim(level, d) + moon_glow_rim(level, d)) * (1.0 - layer.a) + layer.rgb;
}

// As water mirrors it, whose slopes spread the reflected looks up and down and aside, and up and down those that no sample resolves
// (deviations, rad). r: their mean, over the horizon.
// Two looks stand for them in the air, whose light bends most along the horizon.
vec3 mirrored_sky(vec3 r, vec3 spread) {
    float level = length(r.xz);
    vec3 aside = 0.8 * min(spread.x, r.y) * vec3(-r.y * r.xz / max(level, 1e-6), level).xzy;
    vec3 air = 0.5 * (clear_sky(normalize(r + aside)) + clear_sky(normalize(r - aside)));
    float hidden;
    return behind_clouds(air, r, vec2(1.15 * spread.x, spread.y), hidden);
}
