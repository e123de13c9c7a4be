// Rain under the thickest clouds: veils that stand around at three distances, and slant. docs/formulae.md, section 9.
uniform float u_cloud_rain; // optical depth

const float RAIN_LIGHT = 0.55;           // of the mean of clouds
const vec3 RAIN_SLANT = vec3(0.2, 0.1, -0.25); // cells, from the clouds' foot to the water: what is lower left the clouds earlier
const float RAIN_SPREADS = 0.06;         // cells, over the same fall
const float RAIN_FADES = 30000.0;        // m

// Light from behind the rain toward d, and its own; hidden: how much of what is behind all air.
vec3 in_rain(vec3 light, vec3 d, vec2 spread, inout float hidden) {
    float level = length(d.xz);
    float high = u_cloud_shape.x - u_eye_height;
    if (d.y <= 0.0 || high <= 0.0) {
        return light;
    }
    float cell = 1.0 / u_cloud_shape.y;
    vec3 eye = vec3(u_cloud_phase[0], u_cloud_phase[1], u_cloud_phase[2]) * 40.7436654315252;
    float depth = 0.0;
    for (int i = 0; i < 3; ++i) {
        float far = (2.0 + float(i) * (2.0 + float(i))) * u_cloud_shape.y;
        // Height of the look there, of the clouds' foot.
        float up = far * d.y / (max(level, 1e-3) * high);
        if (up >= 1.0) {
            continue;
        }
        vec3 at = eye + vec3(d.xz / max(level, 1e-3) * far * cell, 0.0) + RAIN_SLANT * (1.0 - up);
        float width = CLOUD_WIDTH * spread.y * far * cell + RAIN_SPREADS * (1.0 - up);
        float rest;
        float noise = cloud_octaves(at, width, 3, rest).x;
        float falls = smoothstep(0.0, 2.0, noise - max(u_cloud_shape.z, -0.6));
        depth += falls * (1.0 - smoothstep(0.2, 1.0, up)) * exp(-far / RAIN_FADES);
    }
    float left = exp(-u_cloud_rain * depth);
    hidden = 1.0 - (1.0 - hidden) * left;
    return mix(RAIN_LIGHT * u_cloud_far.rgb / max(u_cloud_far.a, 1e-3), light, left);
}
