// High clouds of ice: streaks of gradient noise, where broad patches of it let them be. docs/formulae.md, section 9.
uniform float u_cirrus_phase[4]; // the eye's place: along the streaks and across in the streaks' noise, then in the patches'; rad
uniform vec4 u_cirrus_shape;     // height (m), size (m), noise where they begin, optical depth
uniform vec2 u_cirrus_along;     // heading of the streaks
uniform vec3 u_cirrus_light;     // irradiance up there
uniform vec3 u_cirrus_sky;       // radiance of the light that comes from all sides

const float CIRRUS_STRETCH = 8.0;

// Premultiplied light of the streaks toward d, and how much they cover of the sky there; hidden: how much of what is behind all air.
vec4 cirrus(vec3 d, vec2 spread, out float hidden) {
    hidden = 0.0;
    float seen = smoothstep(0.01, 0.1, d.y) * (1.0 - smoothstep(0.5, 0.9, u_eye_height / u_cirrus_shape.x));
    if (seen <= 0.0) {
        return vec4(0.0);
    }
    vec2 way = way_to_layer(d, u_cirrus_shape.x - u_eye_height);
    float cell = 1.0 / u_cirrus_shape.y;
    vec2 at = way.x * cell * vec2(dot(d.xz, u_cirrus_along), d.z * u_cirrus_along.x - d.x * u_cirrus_along.y);
    float width = CLOUD_WIDTH * way.x * cell * max(spread.x / way.y, spread.y);
    vec2 streak = vec2(u_cirrus_phase[0], u_cirrus_phase[1]) * 40.7436654315252 + at * vec2(1.0 / CIRRUS_STRETCH, 1.0);
    vec2 spot = vec2(u_cirrus_phase[2], u_cirrus_phase[3]) * 40.7436654315252 + at * vec2(0.125, 0.25);
    float broad = fractal_2(spot, 0.25 * width, 2, uint(CIRRUS_SEED));
    // Winds that shear bend the streaks.
    streak.y += 0.35 * broad;
    float fine = fractal_2(3.0 * streak, 3.0 * width, 5, uint(CIRRUS_SEED + 8));
    float density = smoothstep(0.0, 2.4, broad - u_cirrus_shape.z) * smoothstep(-1.2, 2.4, fine + 0.5 * broad);
    hidden = seen * (1.0 - exp(-u_cirrus_shape.w * density));
    float cover = hidden * exp(-0.8 * min(max(air_depth(d.y).x, 0.0), 60.0));
    float lit = 0.2 + 0.3 * mie_phase(dot(d, u_sun_direction));
    return vec4((u_cirrus_light * lit + u_cirrus_sky) * cover, cover);
}
