// A layer of clouds over a round earth: gradient noise that drifts and changes, lit from the lamp's side. docs/formulae.md, section 9.
// Its place is reduced in float64; the noise repeats after 256 cells.
uniform float u_cloud_phase[3];  // the eye's place in the noise: x, z, time; rad, a turn is 256 cells
uniform vec4 u_cloud_shape;      // height (m), size (m), density 0 at this much noise, optical depth
uniform float u_cloud_softness;
uniform float u_cloud_mean;      // share of light that the layer takes in the mean
uniform vec3 u_cloud_toward;     // toward what lights it
uniform vec3 u_cloud_light;      // irradiance up there
uniform vec3 u_cloud_sky;        // radiance of the light that comes from all sides

const float EARTH = 6.371e6;     // radius, m

float cloud_density(float noise) {
    return smoothstep(0.0, 1.0, (noise - u_cloud_shape.z) / u_cloud_softness);
}

// Premultiplied light of the clouds toward d, and how much they cover of the sky there, seen with a blur (rad); hidden: how
// much of what is behind all air.
vec4 clouds(vec3 d, float blur, out float hidden) {
    hidden = 0.0;
    // Clouds drown in the air along the horizon; from above there are none.
    float seen = smoothstep(0.01, 0.08, d.y) * (1.0 - smoothstep(0.5, 0.9, u_eye_height / u_cloud_shape.x));
    if (seen <= 0.0) {
        return vec4(0.0);
    }
    float high = u_cloud_shape.x - u_eye_height;
    float along = EARTH * d.y;
    // The way to the layer without the difference of two great numbers.
    float way = (2.0 * EARTH * high + high * high) / (along + sqrt(along * along + 2.0 * EARTH * high + high * high));
    float slant = (along + way) / (EARTH + high);
    float cell = 1.0 / u_cloud_shape.y;
    vec3 eye = vec3(u_cloud_phase[0], u_cloud_phase[1], u_cloud_phase[2]) * 40.7436654315252;
    vec3 place = eye + vec3(d.xz * way * cell, 0.0);
    float width = blur * way * cell / slant;
    float density = cloud_density(fractal_3(place, width, CLOUD_OCTAVES, uint(CLOUD_SEED)));
    // Toward the lamp: what lies there stands in its light.
    vec2 level = u_cloud_toward.xz / max(length(u_cloud_toward.xz), 1e-6);
    float before = cloud_density(fractal_3(place + vec3(0.18 * level, 0.0), width, max(CLOUD_OCTAVES - 2, 1), uint(CLOUD_SEED)));
    // Cells too narrow to be told apart: their mean.
    float unresolved = smoothstep(0.15, 0.6, width);
    float deep = u_cloud_shape.w * density;
    hidden = seen * mix(1.0 - exp(-deep), u_cloud_mean, unresolved);
    float gamma = dot(d, u_cloud_toward);
    float edge = mie_phase(gamma);
    float lit = 0.3 * (0.15 + 0.85 * exp(-0.5 * u_cloud_shape.w * before)) + 0.3 * edge * exp(-deep);
    vec3 light = u_cloud_light * lit + u_cloud_sky * (1.0 - 0.4 * density);
    float cover = hidden * exp(-0.8 * min(max(air_depth(d.y).x, 0.0), 60.0));
    return vec4(light * cover, cover);
}
